// Rays from places of a chart side: do they start inside of a solid?
#pragma once

#include "dlm/contact_regions.h"

namespace lucarne {

struct RayVotes {
  int rays = 0;        // 0: the place is not on the surface
  int backs = 0;       // that met the back of an opaque triangle first
  int blackBacks = 0;  // of them those that are one-sided
  int soles = 0;  // rays again, where a sole is under the place: an opaque triangle of another chart that faces the
                  // other way, in the surface or up to a texel beneath
};

/// From a little above each place (texel coordinates), one along the normal and eight around it that rise by 20°.
std::vector<RayVotes> castFromChart(const ContactScene& in, std::uint32_t chart, bool back,
                                    const std::vector<Vec2d>& places);

}  // namespace lucarne
