// How a hit is counted among the directions of Ω.
#pragma once

#include <array>
#include <cstdint>

namespace lucarne {

/// nearest: in the cell of Ω that it falls into. linear: shared among the three ψ around it (direction_triangles.h),
/// where all three are members of the side's set; else as nearest.
enum class DirectionFilter : std::uint8_t { nearest, linear };

/// As settings and files name them, in the order of the filters.
inline constexpr std::array<const char*, 2> kDirectionFilters = {"nearest", "linear"};
constexpr const char* nameOf(DirectionFilter filter) { return kDirectionFilters[static_cast<std::size_t>(filter)]; }

}  // namespace lucarne
