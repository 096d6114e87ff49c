// A kernel for each texel: the one of least expected error.
//
// Level 0 is the texel's own light (a box): unbiased, but the noisiest; wider pyramids are smoother and blur. Of level l
// with estimate E_l and variance V_l the squared bias is (E_l − E_0)² − Var(E_l − E_0) on average, which is taken over
// a window of texels, since that of one texel is noise. The level of least bias² + V is chosen. With ever more photons V
// vanishes and what has any bias goes: maps converge to the texels' box averages. (Expected-error selection of
// bandwidths: Hachisuka, Jarosz, Jensen 2010, "A progressive error estimation framework for photon density estimation",
// section 3.)
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dlm/kernel.h"
#include "dlm/side_resolver.h"

namespace lucarne {

/// Luminance of one level's estimate and its variance, by texel, any unit and its square.
struct LevelEstimate {
  std::vector<double> value, variance;
};

struct LevelChoice {
  std::vector<std::uint8_t> level;  // by texel
  std::vector<double> biasSquared;  // of the level chosen, as estimated; ≥ 0
};

/// `own`: by level and texel, what the texel's own light weighs in the level's estimate. Texels without surface of their own take the second level, that of the coarsest step that can.
LevelChoice chooseLevels(int width, int height, const std::vector<LevelEstimate>& levels,
                         const std::vector<std::vector<double>>& own, const std::vector<bool>& hasSurface);

/// The resolvers of a side's kernels, of which each texel uses one; filters as SideResolver does.
class LevelResolver {
 public:
  /// `kernels` and `contacts` must outlive this.
  LevelResolver(int width, int height, std::span<const double> area, std::span<const Kernel> kernels,
                const SideContacts& contacts);
  LevelResolver(const LevelResolver&) = delete;
  LevelResolver& operator=(const LevelResolver&) = delete;

  std::size_t levels() const { return resolvers_.size(); }
  const SideResolver& level(std::size_t l) const { return resolvers_[l]; }
  /// One level for each texel. Until then all use the last.
  void choose(std::vector<std::uint8_t> levelOfTexel);

  std::vector<Rgbd> filterRgb(std::span<const std::int64_t> units) const;
  std::vector<double> filterValues(std::span<const double> values) const;
  std::vector<double> filterDifferences(std::span<const double> values) const;
  std::vector<double> sumUnderKernel(std::span<const double> values) const;
  std::vector<Rgbd> filterMeans(std::span<const std::int64_t> means, std::span<const double> area) const;
  std::vector<double> filterSquares(std::span<const double> values) const;

 private:
  template <class F>
  auto mixed(F&& filter) const;
  std::vector<SideResolver> resolvers_;
  std::vector<std::uint8_t> levelOfTexel_;
};

}  // namespace lucarne
