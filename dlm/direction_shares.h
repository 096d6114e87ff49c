// What of a hit each map of a chart side gets.
#pragma once

#include <array>
#include <cstdint>

#include "dlm/direction_set.h"
#include "dlm/tally.h"

namespace lucarne {

/// Up to three maps of a side, by rank, and running sums of what they get, in units of 1/DirectionWeights::kWhole.
struct DirectionShares {
  std::array<std::uint16_t, 3> rank{};
  std::array<std::uint32_t, 3> upTo{};

  /// The part of each of a whole number of units ≥ 0. `bits`, 0 … 65535 evenly: each part is rounded with the
  /// probability of its fraction, and the three sum to the whole exactly, the last getting what the others leave.
  std::array<std::int64_t, 3> split(std::int64_t units, std::uint32_t bits) const {
    std::array<std::int64_t, 3> parts;
    std::int64_t before = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto sum = static_cast<std::int64_t>((Int128{units} * upTo[k] + bits) >> 16);
      parts[k] = sum - before;
      before = sum;
    }
    return parts;
  }
};

/// Of a direction on a side with maps by direction. Where not all three ψ around it are members, its cell takes all, as
/// with the filter `nearest`.
[[gnu::always_inline]] inline DirectionShares directionShares(const DirectionSet& set, const std::uint16_t* rank,
                                                              const std::uint16_t* members, Vec3f wi) {
  constexpr std::uint32_t kWhole = DirectionWeights::kWhole;
  if (const DirectionTriangles* triangles = set.triangles()) {
    const DirectionWeights w = triangles->around(wi);
    const std::array<std::uint16_t, 3> r{rank[w.psi[0]], rank[w.psi[1]], rank[w.psi[2]]};
    if (members[r[0]] == w.psi[0] && members[r[1]] == w.psi[1] && members[r[2]] == w.psi[2])
      return {r, {w.weight[0], w.weight[0] + w.weight[1], kWhole}};
  }
  const std::uint16_t r = rank[static_cast<std::size_t>(set.nearest(wi))];
  return {{r, r, r}, {kWhole, kWhole, kWhole}};
}
inline DirectionShares directionShares(const DirectionSet& set, const MemberSet& members, Vec3f wi) {
  return directionShares(set, members.rank.data(), members.members.data(), wi);
}

}  // namespace lucarne
