// Seams: edges along which two charts continue each other, and what their maps say on both sides of them.
//
// An edge of two triangles is a seam when they are all that meet there, belong to two charts, face the same way round
// and have the same shading normals at both of its ends (within 2°): then light on both is the same, whatever the
// materials. Edges where a contact touches the texels (a wall on the joint of two floors) are none.
//
// Edges that nothing shares with its ends are seams as far as they run along each other (edge_overlaps.h, within the
// weld tolerance of charts.h), by the same rules: one edge of a floor along the many of another, edges shifted against
// each other.
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

/// A place on a seam: two a texel's length, one a seam at least.
struct SeamSample {
  std::uint32_t sideA, sideB;  // of LightMaps::sides
  SideLookup a, b;
  double length;  // of the seam that it stands for, metres
};

/// An edge, or the part of it that another runs along; its samples are numbered through.
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
