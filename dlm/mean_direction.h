// Mean directions: where the light of a cell of Ω came from, on average, and how far it spreads.
//
//   m = Σ l·wi / Σ l     l luminance, wi unit toward the light; |m| ≤ 1
//
// Its direction is that of the light; |m| is 1 where all came from one point, and about 1 − 1/|Ω| where it fills the cell
// evenly. Vectors m may be averaged and interpolated like the moments that they are made of; directions and spreads apart
// could not.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "dlm/direction_filter.h"

namespace lucarne {

/// Bytes of a packed mean direction: a third of three floats, and still 1/1023 of a cell fine.
inline constexpr std::uint64_t kMeanBytes = 4;

/// No component of m − ψ is larger, for a set of |Ω| directions: 3/√|Ω|, at most 2. The corners of the cells are at
/// most 2.9/√|Ω| from their ψ. Where light is shared among three ψ (`linear`) 5.5/√|Ω|: ψ that share are at most that far
/// apart.
float meanReach(int directionCount, DirectionFilter filter = DirectionFilter::nearest);

/// (m − ψ)/reach in three unsigned numbers of 10 bits, −1 … 1 as 0 … 1023, x lowest; the top two bits are 0. What
/// GL_UNSIGNED_INT_2_10_10_10_REV is to GL_RGB10_A2. Beyond ±1 it is cut.
std::uint32_t packMean(Vec3f mean, Vec3f psi, float reach);
/// No longer than 1.
Vec3f unpackMean(std::uint32_t code, Vec3f psi, float reach);
constexpr bool isMeanCode(std::uint32_t code) { return code >> 30 == 0; }

/// The same vector, or that of length 1 where it is longer.
Vec3f boundedMean(Vec3f mean);

}  // namespace lucarne
