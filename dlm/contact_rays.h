// Rays from places of a chart side: do they start inside of a solid?
#pragma once

#include "dlm/contact_regions.h"

namespace lucarne {

struct RayVotes {
  int rays = 0;   // 0: the place is not on the surface
  int backs = 0;  // that met the back of a one-sided triangle first
};

/// From a little above each place (texel coordinates), one along the normal and eight around it that rise by 20°.
std::vector<RayVotes> castFromChart(const ContactScene& in, std::uint32_t chart, bool back,
                                    const std::vector<Vec2d>& places);

}  // namespace lucarne
