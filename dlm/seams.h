// Seams: edges along which two charts continue each other, and what their maps say on both sides of them.
//
// An edge of two triangles is a seam when they are all that meet there, belong to two charts, face the same way round
// and have the same shading normals at both of its ends (within 2°): then light on both is the same, whatever the
// materials. Edges where a contact touches the texels (a wall on the joint of two floors) are none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dlm/charts.h"
#include "dlm/light_maps.h"
#include "dlm/texel_contacts.h"
#include "dlm/texel_layout.h"

namespace lucarne {

/// What bilinear lookup takes from the texels of one side at one place.
struct SideLookup {
  std::array<std::uint32_t, 4> texel;  // of the side
  std::array<double, 4> weight;        // sum 1
};

/// A place on a seam, twice a texel's length.
struct SeamSample {
  std::uint32_t sideA, sideB;  // of LightMaps::sides
  SideLookup a, b;
  double length;  // of the seam that it stands for, metres
};

/// An edge; its samples are numbered through.
struct Seam {
  std::size_t first, end;
};

struct SeamSet {
  std::vector<Seam> seams;
  std::vector<SeamSample> samples;
};

/// Between sides of `maps` that are lit. `contacts` by side, or empty.
SeamSet findSeams(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const LightMaps& maps,
                  std::span<const SideContacts> contacts);

}  // namespace lucarne
