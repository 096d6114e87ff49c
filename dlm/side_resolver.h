// The weights of one chart side: kernel sums over open area, and where texels without it take their value from. Texels
// that contacts separate or cut (texel_contacts.h) give nothing to each other.
//
// Local linear estimation (Fan 1992; Walter, Hubbard, Shirley, Greenberg 1997, section 5). Where the surface under the
// kernel lies to one side, at a chart's edge or at the foot of a wall, the mean under the kernel is that of a place
// further in. The least-squares plane through the densities tally(t')/area(t') with weights k·area has at the centre
// the value of the same mean with weights that lean:
//     k(d) · (1 + a·d),   with a such that  Σ k(d)·area·(1 + a·d)·d = 0,   d = t' − t
// so that linear light is met without bias, for more noise at the edges. In the middle of a chart a = 0. Far weights are
// negative, down to −1.4 k in a corner; what comes out negative is 0.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "dlm/kernel.h"
#include "dlm/texel_contacts.h"

namespace lucarne {

class SideResolver {
 public:
  /// `area`: surface in each of the width × height texels, any unit. `contacts` and `kernel` must outlive this.
  SideResolver(int width, int height, std::span<const double> area, const Kernel& kernel, const SideContacts& contacts);

  /// Per texel: (Σ k·units(t')) / (Σ k·area(t')) per channel, `units` interleaved [texel][channels].
  std::vector<Rgbd> filterRgb(std::span<const std::int64_t> units) const;
  /// Per texel: (Σ k·values(t')) / (Σ k·area(t')).
  std::vector<double> filterValues(std::span<const double> values) const;
  /// The same of differences, which may be negative.
  std::vector<double> filterDifferences(std::span<const double> values) const;
  /// Per texel: Σ values(t') over the texels that weigh anything.
  std::vector<double> sumUnderKernel(std::span<const double> values) const;
  /// Per texel: (Σ k·means(t')·area(t')) / (Σ k·area(t')) per channel, `area` as given before.
  std::vector<Rgbd> filterMeans(std::span<const std::int64_t> means, std::span<const double> area) const;
  /// Per texel: Σ k²·values(t') over the square of Σ k·area(t').
  std::vector<double> filterSquares(std::span<const double> values) const;
  /// From now on only texels for which levels[t] is `level` are worked out; the others are 0, and none is copied.
  /// `levels` must outlive this.
  void restrictTo(std::span<const std::uint8_t> levels, std::uint8_t level);
  /// Per texel: 1 / Σ k·open area; 0 where there is none.
  std::span<const double> inverseArea() const { return inverseArea_; }
  /// The texel that a texel takes its value from: itself where it has one, kNone where none has.
  std::uint32_t source(std::size_t t) const { return source_[t]; }

 private:
  bool skips(std::size_t t) const { return !levels_.empty() && levels_[t] != level_; }
  /// Per texel: Σ term(t', k) times 1 / Σ k·area, `power` times.
  template <class T, class F>
  std::vector<T> filter(int power, F&& term) const;
  template <class F>
  void forNeighbours(int x, int y, F&& f) const;
  void lean(std::span<const double> area);
  /// With weights that lean: negative values are 0.
  template <class T>
  std::vector<T> notNegative(std::vector<T> values) const;
  template <class T>
  void spread(std::vector<T>& values) const;
  void findSources();
  void spreadSources(std::vector<std::uint32_t>& queue, bool acrossContacts);

  int width_, height_;
  const Kernel& kernel_;
  const SideContacts& contacts_;
  std::vector<double> inverseArea_;    // 1 / Σ k·open area; 0: no surface within the kernel, or hidden
  std::vector<Vec2d> lean_;            // a by texel; empty: 0
  std::vector<std::uint32_t> source_;  // texel to copy from; itself where it has a value
  std::span<const std::uint8_t> levels_;
  std::uint8_t level_ = 0;
};

}  // namespace lucarne
