// Finished light maps in memory: what resolve makes, what a .dlm holds, what probe, render and play read.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "dlm/direction_filter.h"
#include "dlm/direction_set.h"

namespace lucarne {

/// One ψ of one chart side. `first` is the index of its first texel in LightMaps::directional, or kEmptyMap: its map is
/// zero everywhere and was dropped. It is still a member: constant light is normalised over all members.
struct SideDirection {
  static constexpr std::uint64_t kEmptyMap = ~std::uint64_t{0};
  std::uint16_t psi = 0;
  std::uint64_t first = kEmptyMap;
  bool stored() const { return first != kEmptyMap; }
};

/// The light maps of one side of a chart, width × height texels, rows top first.
struct SideMaps {
  std::uint32_t chart = 0;
  bool back = false;
  bool lit = false;             // false: everything zero, no texels stored at all
  int width = 0, height = 0;
  std::uint64_t firstTexel = 0; // into irradiance, error, photons
  // Members of Ω on this side, ψ ascending. Empty: no lobe needs directions, the irradiance is all there is.
  std::vector<SideDirection> directions;
  std::uint64_t texelCount() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// Per chart: the plane it was projected on (for flat charts the exact normal), local space.
struct MapChart {
  std::uint32_t material = 0;
  bool smooth = false;  // light is stored as the interpolated shading normal receives it
  bool planar = true;   // all triangles share `normal` (to 1e-4); otherwise normals vary inside the chart
  Vec3f normal{};       // front
  double texelSize = 0; // metres, geometric mean of the two sides of a texel
  std::uint32_t frontSide = 0xffffffffu, backSide = 0xffffffffu;  // into LightMaps::sides, or kNone: absorbs unseen
  int atlasX = 0, atlasY = 0;  // first texel of its rectangle in the irradiance atlas
  int width = 0, height = 0;
};

struct LightMaps {
  int directionCount = 1;      // |Ω|; DirectionSet(directionCount, directionFilter) rebuilds the set
  DirectionFilter directionFilter = DirectionFilter::nearest;
  std::vector<MapChart> charts;
  std::vector<SideMaps> sides;
  int atlasWidth = 0, atlasHeight = 0;  // uv1 = (atlasX + s, atlasY + t) / (atlasWidth, atlasHeight), st texel coordinates

  // Texels. Values in texels that hold no surface are dilated from their neighbours, so bilinear lookup (clamped to the
  // rectangle) never reads an unwritten one.
  std::vector<Rgb> irradiance;        // lx, [side.firstTexel + y·width + x]
  std::vector<float> standardError;   // estimated, of the luminance of E; lx. See texel_error.h
  std::vector<float> relativeError;   // the same over E; 0 where dark
  std::vector<float> photons;         // photons that fell into the texel
  std::vector<Rgb> directional;       // lx, B(s,ψ): [direction.first + y·width + x]
  std::vector<Vec3f> meanDirections;  // of the light in each texel of directional (mean_direction.h); empty: not known
  bool hasMeans() const { return !meanDirections.empty(); }
};

}  // namespace lucarne
