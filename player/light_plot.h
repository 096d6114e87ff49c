// The light of a place by direction, as a disc: the hemisphere above it seen from straight above.
#pragma once

#include <vector>

#include "dlm/probe.h"

namespace lucarne {

/// One direction in the disc of radius 1. By Nusselt's analogy a share of the disc is the share of the irradiance that
/// light of one radiance from there would give: spots cover about what their cells do.
struct LightSpot {
  Vec2d centre{};     // x right, y up in the disc
  double radius = 0;  // of a spot as large as the cell's part
  Rgbd radiance{};    // mean over the cell, cd/m²
};

/// `normal`: unit. Right in the disc is horizontal, up is what of +y (else −z) lies in the surface.
std::vector<LightSpot> lightSpots(const ProbeAnswer& answer, Vec3d normal);

/// Inside a window of Dear ImGui; the brightest spot is white. `radius` of the disc in pixels.
void drawLightPlot(const ProbeAnswer& answer, Vec3d normal, float radius);

}  // namespace lucarne
