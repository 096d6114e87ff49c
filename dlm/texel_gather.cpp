#include "dlm/texel_gather.h"

#include <cmath>

#include "base/float_mode.h"
#include "dlm/direction_shares.h"
#include "dlm/texel_surface.h"
#include "tracer/optics/cumulative.h"

namespace lucarne {
namespace {

/// The texels of a chart that the kernel about (x, y) reaches.
TexelTile tileAbout(std::uint32_t chart, const ChartLayout& layout, int x, int y, int radius) {
  const int left = std::max(0, x - radius), top = std::max(0, y - radius);
  return {chart, left, top, std::min(layout.width, x + radius + 1) - left,
          std::min(layout.height, y + radius + 1) - top};
}

/// The surface that the kernel about one texel reaches.
class KernelSurface {
 public:
  KernelSurface(const GatherScene& in, const TallySide& side, const SideContacts& contacts, int x, int y,
                const Kernel& kernel)
      : tile_(tileAbout(side.chart, in.layout.charts[side.chart], x, y, kernel.radius)),
        surface_(in.scene.scene(), in.charts, in.layout, tile_) {
    const ChartLayout& layout = in.layout.charts[side.chart];
    const auto texel = [&layout](int u, int v) { return static_cast<std::size_t>(v * layout.width + u); };
    if (contacts.hidden(texel(x, y))) return;
    for (int v = tile_.y; v < tile_.y + tile_.height; ++v) {
      for (int u = tile_.x; u < tile_.x + tile_.width; ++u) {
        const double share = contacts.share(texel(u, v));
        const bool counts = share > 0 && !contacts.separated(texel(x, y), u - x, v - y);
        const double k = counts ? kernel(u - x) * kernel(v - y) : 0;
        cumulative_.push_back(k * surface_.area(cumulative_.size()));
        kernelArea_ += k * share * in.layout.area[layout.firstTexel + texel(u, v)];
      }
    }
    guide_.resize(cumulative_.size());
    surfaceSum_ = makeCumulative(cumulative_);
    makeGuide(cumulative_, guide_);
  }

  bool empty() const { return !(surfaceSum_ > 0 && kernelArea_ > 0); }
  /// Σ k·surface over Σ k·area: what a sample of E·α is multiplied with.
  double scale() const { return surfaceSum_ / kernelArea_; }
  TexelPlace sample(double pick, Vec2f u) const {
    const Choice texel = choose(cumulative_, guide_, pick);
    return surface_.sample(texel.index, {std::min(static_cast<float>(texel.rest), 1 - 0x1p-24f), u.x, u.y});
  }

 private:
  TexelTile tile_;
  TexelSurface surface_;
  double kernelArea_ = 0, surfaceSum_ = 0;
  std::vector<double> cumulative_;  // of k · surface, by texel of the tile
  std::vector<std::uint32_t> guide_;
};

class Moments {
 public:
  void add(double x) {
    sum_ += x;
    squares_ += x * x;
  }
  GatherValue over(std::uint64_t samples) const {
    const auto n = static_cast<double>(samples);
    const double mean = sum_ / n, variance = std::max(0.0, squares_ / n - mean * mean);
    return {mean, std::sqrt(variance / std::max(1.0, n - 1))};
  }

 private:
  double sum_ = 0, squares_ = 0;
};

void addShares(const DirectionShares& shares, double light, std::vector<double>& byRank) {
  std::uint32_t before = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    byRank[shares.rank[k]] += light * (shares.upTo[k] - before) / DirectionWeights::kWhole;
    before = shares.upTo[k];
  }
}

}  // namespace

TexelGatherResult gatherTexel(const GatherScene& in, std::uint32_t sideIndex, int x, int y,
                              const KernelOptions& options, LightPart part, std::uint64_t samples, std::uint64_t seed) {
  const FlushDenormals mode;
  const TallySide& side = in.tallies.sides[sideIndex];
  const MemberSet& members = in.tallies.membersOf(side);
  const Kernel kernel = makeKernel(options);
  const SideContacts none;
  const KernelSurface surface(in, side, in.contacts.empty() ? none : in.contacts[sideIndex], x, y, kernel);
  TexelGatherResult result;
  result.byRank.resize(members.mapCount());
  if (surface.empty()) return result;
  result.covered = true;
  const PathTracer paths(in.scene);
  std::vector<Moments> moments(members.mapCount());
  std::vector<double> shares(members.mapCount());
  Moments whole;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const PhotonSampler sampler(seed, i);
    const auto w = sampler.words(0, Stream::place);
    const auto place = surface.sample(toUnitDouble(w[0], w[1]), {toUnitFloat(w[2]), toUnitFloat(w[3])});
    const Receiver at = receiverAt(in.scene, place.triangle, place.b, side.back);
    const double there =
        static_cast<double>(in.scene.surfaces().coverage(placeOf(at.hit), side.back)) * surface.scale();
    std::fill(shares.begin(), shares.end(), 0.0);
    double sum = 0;
    const ReceivedLight light = paths.receive(at, sampler);
    for (std::size_t k = 0; k < light.count; ++k) {
      const ReceivedLight::Piece& piece = light.pieces[k];
      if (part != LightPart::all && (part == LightPart::direct) != piece.direct) continue;
      const Rgbd lux = Rgbd(piece.lux) * there;
      result.irradiance += lux;
      if (members.members.empty())
        shares[0] += luminance(lux);
      else
        addShares(directionShares(in.directions, members, piece.wi), luminance(lux), shares);
      sum += luminance(lux);
    }
    whole.add(sum);
    for (std::size_t r = 0; r < shares.size(); ++r) moments[r].add(shares[r]);
  }
  result.irradiance = result.irradiance / static_cast<double>(samples);
  result.luminance = whole.over(samples);
  for (std::size_t r = 0; r < shares.size(); ++r) result.byRank[r] = moments[r].over(samples);
  return result;
}

}  // namespace lucarne
