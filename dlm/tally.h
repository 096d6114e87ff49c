// Tallies: where the light of photons is counted. Integers in fixed point, so that sums have no order.
//
// Light:      [chart side][ψ][y][x][r, g, b]   Σ beta, in units of 2^-24 of the scene's emitted flux
// Statistics: [chart side][y][x][count, m2, odd]  photons that fell into the texel; Σ (luminance of a photon's whole
//             share of the texel)², per photon, since one path may come back to a texel; and Σ luminance of the
//             photons of odd index, which says how far the two halves of all photons differ. Units of 2^-24.
// Moments:    [glossy chart side][ψ][y][x][x, y, z]  Σ luminance·(1 + wi)/2 by component, wi in world space: with the
//             light, the mean direction of what fell into the cell. Never negative. Units of 2^-24; only on sides with maps
//             by direction, and only where they are asked for.
// Canonical order is memory order, light first, then statistics, then moments; content_hash is XXH3-128 over it,
// little-endian.
//
// A second set of the same shape counts direct light where it is gathered (direct_gather.h) instead of brought by
// photons: it follows the first in canonical order.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/huge_buffer.h"
#include "dlm/charts.h"
#include "dlm/direction_set.h"
#include "dlm/texel_layout.h"
#include "tracer/transport/ledger.h"

namespace lucarne {

inline constexpr std::uint64_t kLightChannels = 3, kStatisticsChannels = 3, kMomentChannels = 3;
/// Channels of the statistics.
inline constexpr std::uint64_t kCount = 0, kSquares = 1, kOdd = 2;

/// v in fixed point, rounded up with the probability of the fraction, so that small values are kept on average: to
/// nearest in units of 1/256, then the low 8 bits of `word` are added and 8 bits dropped. The mean is off by at most
/// 2^-9 units. v ≤ 2^30.
inline std::int64_t roundUnits(float v, std::uint32_t word) {
  return (std::llrint(v * (kFixedPointOne * 256)) + static_cast<std::int64_t>(word & 0xffu)) >> 8;
}

/// What light from unit direction `wi` adds to the moments: light·(1 + wi)/2 by component, kept from falling below 0 by
/// the rounding of wi.
inline Vec3f momentOf(float light, Vec3f wi) {
  const auto part = [light](float c) { return std::max(0.f, light * (0.5f + 0.5f * c)); };
  return {part(wi.x), part(wi.y), part(wi.z)};
}

/// Members of Ω on one side: shared by all sides with the same set.
struct MemberSet {
  std::vector<std::uint16_t> members;  // ψ of rank k, ascending; empty: irradiance only, one map that takes all
  // Rank by ψ. A ψ that is no member (a hit within rounding of the horizon) goes to the member nearest to it.
  std::vector<std::uint16_t> rank;
  std::uint64_t mapCount() const { return members.empty() ? 1 : members.size(); }
};

struct TallySide {
  std::uint32_t chart = 0;
  bool back = false;
  int width = 0, height = 0;
  std::uint32_t memberSet = 0;
  std::uint64_t firstLight = 0;  // in (texel, ψ) entries
  std::uint64_t firstTexel = 0;
  std::uint64_t firstMoment = 0;  // likewise; of sides with maps by direction, where there are moments
  std::uint64_t texelCount() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

struct TallyLayout {
  std::vector<TallySide> sides;
  std::vector<std::uint32_t> frontSide, backSide;  // by chart; kNone: no maps
  std::vector<MemberSet> memberSets;
  std::uint64_t lightEntries = 0, texels = 0;
  std::uint64_t momentEntries = 0;  // 0: no moments
  std::uint64_t bytes() const {
    return 8 * (lightEntries * kLightChannels + texels * kStatisticsChannels + momentEntries * kMomentChannels);
  }
  const MemberSet& membersOf(const TallySide& side) const { return memberSets[side.memberSet]; }
};

/// What is counted beyond the light that materials need.
struct TallyWishes {
  bool keepAllDirections = false;  // the full set also on sides whose material needs none
  bool moments = false;
};
TallyLayout planTallies(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const DirectionSet& directions,
                        const TallyWishes& wishes = {});

class Tallies {
 public:
  enum class Sets : std::uint8_t { photons, photonsAndDirect };

  explicit Tallies(const TallyLayout& layout, Sets sets = Sets::photons)
      : Tallies(layout.lightEntries, layout.texels, sets, layout.momentEntries) {}
  Tallies(std::uint64_t lightEntries, std::uint64_t texels, Sets sets = Sets::photons, std::uint64_t momentEntries = 0)
      : light_(lightEntries * kLightChannels),
        statistics_(texels * kStatisticsChannels),
        moments_(momentEntries * kMomentChannels) {
    if (sets == Sets::photonsAndDirect)
      direct_ = std::make_unique<Tallies>(lightEntries, texels, Sets::photons, momentEntries);
  }
  std::span<std::int64_t> light() const { return light_.span(); }
  std::span<std::int64_t> statistics() const { return statistics_.span(); }
  /// Empty: none.
  std::span<std::int64_t> moments() const { return moments_.span(); }
  /// The set of gathered direct light; null: none.
  Tallies* direct() const { return direct_.get(); }
  /// `other` may lack the second set.
  void add(const Tallies& other);
  void clear();
  Hash128 contentHash() const;

 private:
  void hashInto(Hasher& hasher) const;

  HugeBuffer<std::int64_t> light_, statistics_, moments_;
  std::unique_ptr<Tallies> direct_;
};

}  // namespace lucarne
