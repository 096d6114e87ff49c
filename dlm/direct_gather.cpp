#include "dlm/direct_gather.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/error.h"
#include "base/float_mode.h"
#include "dlm/direction_shares.h"

namespace lucarne {
namespace {

constexpr int kTile = 32;  // texels along an edge
constexpr float kLargestSquare = 0x1p18f;

std::vector<TexelTile> tilesOf(const TexelLayout& layout, const TallyLayout& tallies) {
  std::vector<TexelTile> tiles;
  for (std::uint32_t c = 0; c < layout.charts.size(); ++c) {
    if (tallies.frontSide[c] == kNone && tallies.backSide[c] == kNone) continue;
    const ChartLayout& chart = layout.charts[c];
    for (int y = 0; y < chart.height; y += kTile)
      for (int x = 0; x < chart.width; x += kTile)
        tiles.push_back({c, x, y, std::min(kTile, chart.width - x), std::min(kTile, chart.height - y)});
  }
  return tiles;
}

/// Eight bits at a time for rounding, or other sixteen of the same number, from numbers of a sample that nothing else uses.
class RoundingBits {
 public:
  RoundingBits(const std::array<std::uint32_t, 4>& words, std::uint64_t number)
      : key_(mix64(number) ^ (std::uint64_t{words[3]} << 32)) {}
  std::uint32_t next() { return static_cast<std::uint32_t>(mix64(key_ += 0x9e3779b97f4a7c15u) >> 56); }
  std::uint32_t nextWide() { return static_cast<std::uint32_t>(mix64(key_ += 0x9e3779b97f4a7c15u) & 0xffffu); }

 private:
  std::uint64_t key_;
};

}  // namespace

double directUnit(double emittedFlux, const TexelLayout& layout, double metresPerLocal) {
  const double local = std::accumulate(layout.area.begin(), layout.area.end(), 0.0);
  const double area = local * metresPerLocal * metresPerLocal;
  return area > 0 && emittedFlux > 0 ? emittedFlux / area : 1;
}

DirectGather::DirectGather(const GatherScene& scene, const PhotonSeed& seed)
    : in_(scene),
      seed_(mix64(seed.seed ^ 0x6469726563746c79u), seed.kind),  // other numbers than those of photons
      paths_(scene.scene),
      unit_(directUnit(scene.scene.emitters().totalFlux(), scene.layout, scene.scene.scene().frame.scale)),
      tiles_(tilesOf(scene.layout, scene.tallies)) {
  LUCARNE_CHECK_LE(scene.tallies.texels, std::uint64_t{1} << 32);
}

/// One texel of one side, and its tallies.
class DirectGather::Texel {
 public:
  Texel(const DirectGather& gather, const TallySide& side, std::uint64_t texel, const Tallies& set)
      : gather_(gather),
        side_(side),
        members_(gather.in_.tallies.membersOf(side)),
        number_((side.firstTexel + texel) << 32),
        light_(set.light().data() + (side.firstLight + texel) * kLightChannels),
        statistics_(set.statistics().data() + (side.firstTexel + texel) * kStatisticsChannels),
        moments_(set.moments().empty() || members_.members.empty()
                     ? nullptr
                     : set.moments().data() + (side.firstMoment + texel) * kMomentChannels) {}

  /// `share`: surface over area of the texel.
  void sample(std::uint64_t s, const TexelSurface& surface, std::size_t t, double share, DirectCounts& counts) const {
    const PhotonSampler sampler(gather_.seed_, number_ + s);
    const auto w = sampler.words(0, Stream::place);
    const TexelPlace place = surface.sample(t, {toUnitFloat(w[0]), toUnitFloat(w[1]), toUnitFloat(w[2])});
    const Receiver at = receiverAt(gather_.in_.scene, place.triangle, place.b, side_.back);
    ++counts.places;
    const auto alpha = static_cast<double>(gather_.in_.scene.surfaces().coverage(placeOf(at.hit), side_.back));
    if (!(alpha > 0)) return;
    const ReceivedLight light = gather_.paths_.receiveDirect(at, sampler);
    if (light.count == 0) return;
    RoundingBits bits(w, number_ + s), momentBits(w, ~(number_ + s));  // moments leave the light's numbers as they are
    float sum = 0;
    for (std::size_t i = 0; i < light.count; ++i)
      sum += add(light.pieces[i], alpha * share / gather_.unit_, bits, momentBits, counts);
    statistics_[kCount] += 1;
    statistics_[kSquares] += roundUnits(std::min(sum * sum, kLargestSquare), bits.next());
    if (s % 2 == 1) statistics_[kOdd] += roundUnits(sum, bits.next());
  }

 private:
  /// Returns the luminance.
  float add(const ReceivedLight::Piece& piece, double scale, RoundingBits& bits, RoundingBits& momentBits,
            DirectCounts& counts) const {
    Rgb value(Rgbd(piece.lux) * scale);
    if (!isFinite(value) || minComponent(value) < 0) {
      ++counts.strayValues;
      return 0;
    }
    if (const float most = maxComponent(value); most > kLargestDirectValue) {
      value *= kLargestDirectValue / most;
      ++counts.clamped;
    }
    const std::array<std::int64_t, 3> light{roundUnits(value.x, bits.next()), roundUnits(value.y, bits.next()),
                                            roundUnits(value.z, bits.next())};
    if (gather_.in_.directions.triangles() != nullptr && !members_.members.empty()) {
      addShares(piece.wi, light, luminance(value), bits, momentBits);
      return luminance(value);
    }
    const std::size_t rank = members_.members.empty()
                                 ? 0
                                 : members_.rank[static_cast<std::size_t>(gather_.in_.directions.nearest(piece.wi))];
    addTo(light_, rank, kLightChannels, light);
    if (moments_ != nullptr) addTo(moments_, rank, kMomentChannels, momentUnits(luminance(value), piece.wi, momentBits));
    return luminance(value);
  }

  void addTo(std::int64_t* tally, std::size_t rank, std::uint64_t channels,
             const std::array<std::int64_t, 3>& units) const {
    std::int64_t* at = tally + rank * side_.texelCount() * channels;
    for (std::size_t c = 0; c < 3; ++c) at[c] += units[c];
  }

  static std::array<std::int64_t, 3> momentUnits(float light, Vec3f wi, RoundingBits& bits) {
    const Vec3f m = momentOf(light, wi);
    return {roundUnits(m.x, bits.next()), roundUnits(m.y, bits.next()), roundUnits(m.z, bits.next())};
  }

  /// Among the directions. `bits` is a copy: what is rounded later has the numbers that it has without.
  void addShares(Vec3f wi, const std::array<std::int64_t, 3>& light, float luminance, RoundingBits bits,
                 RoundingBits& momentBits) const {
    const DirectionShares shares = directionShares(gather_.in_.directions, members_, wi);
    const auto add = [&](std::int64_t* tally, std::uint64_t channels, const std::array<std::int64_t, 3>& units) {
      std::array<std::array<std::int64_t, 3>, 3> parts;  // [channel][share]
      for (std::size_t c = 0; c < 3; ++c) parts[c] = shares.split(units[c], bits.nextWide());
      for (std::size_t k = 0; k < 3; ++k)
        addTo(tally, shares.rank[k], channels, {parts[0][k], parts[1][k], parts[2][k]});
    };
    add(light_, kLightChannels, light);
    if (moments_ != nullptr) add(moments_, kMomentChannels, momentUnits(luminance, wi, momentBits));
  }

  const DirectGather& gather_;
  const TallySide& side_;
  const MemberSet& members_;
  std::uint64_t number_;  // of sample 0
  std::int64_t* light_;
  std::int64_t* statistics_;
  std::int64_t* moments_;  // null: none
};

DirectCounts DirectGather::gatherTile(const TexelTile& tile, IndexRange samples, const Tallies& set) const {
  const FlushDenormals mode;
  const ChartLayout& chart = in_.layout.charts[tile.chart];
  const TexelSurface surface(in_.scene.scene(), in_.charts, in_.layout, tile);
  DirectCounts counts;
  for (std::size_t t = 0; t < static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height); ++t) {
    const int x = tile.x + static_cast<int>(t) % tile.width, y = tile.y + static_cast<int>(t) / tile.width;
    const auto texel =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(chart.width) + static_cast<std::uint64_t>(x);
    const double area = in_.layout.area[chart.firstTexel + texel];
    if (!(area > 0 && surface.area(t) > 0)) continue;
    for (const std::uint32_t s : {in_.tallies.frontSide[tile.chart], in_.tallies.backSide[tile.chart]}) {
      if (s == kNone) continue;
      const Texel one(*this, in_.tallies.sides[s], texel, set);
      for (std::uint64_t i = samples.begin; i < samples.end; ++i)
        one.sample(i, surface, t, surface.area(t) / area, counts);
    }
  }
  return counts;
}

DirectCounts DirectGather::gather(IndexRange samples, const Tallies& tallies) const {
  LUCARNE_CHECK_EQ(tallies.direct() != nullptr, true);
  LUCARNE_CHECK_LE(samples.end, kMostDirectSamples);
  std::atomic<std::uint64_t> places{0}, clamped{0}, strays{0};
  tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t i) {
    const DirectCounts counts = gatherTile(tiles_[i], samples, *tallies.direct());
    places += counts.places;
    clamped += counts.clamped;
    strays += counts.strayValues;
  });
  return {places, clamped, strays};
}

}  // namespace lucarne
