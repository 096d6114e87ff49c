// What maps by direction need not hold, under a bound on what is lost: faint directions, and next to no colour.
#pragma once

#include <cstdint>

#include "dlm/light_maps.h"

namespace lucarne {

struct DroppedMaps {
  std::uint64_t maps = 0, texels = 0;  // left out; texels of all of them
  std::uint64_t storedTexels = 0;      // before
  double lost = 0;                     // at the texel that lost most, over what the bound is relative to
  std::uint64_t neutralTexels = 0;     // of maps that lost their colour
};

/// Leaves out maps of faint directions: at every texel all that a side loses is at most `bound` times the irradiance, of
/// the texel or of the side in the mean, whichever is more (luminance). Only reflections lose it: the irradiance is a
/// map of its own. The faintest go first, so the most maps go. A map left out remains a member, like one that was black.
/// Then maps that are all but neutral become so: one channel is enough for them. At every
/// texel no component of any of them moves by more than the same bound; luminance stays. 0 ≤ bound < 1; 0 leaves all in place.
DroppedMaps dropFaintMaps(LightMaps& maps, double bound);

}  // namespace lucarne
