// The time section of a check: photons traced for about half a second, and what follows for the whole bake.
#pragma once

#include "app/check_input.h"

namespace lucarne {

/// seconds (of tracing), seconds_of_setup, threads, photons, photons_per_second (all threads, stored as a bake stores
/// them), sampled_tally_bytes (of the tallies stored in; smaller than those of the bake where these are large),
/// bare_photons_per_second (one thread, nothing stored), rays_per_photon, photons_per_texel (that fall into a covered
/// texel, on average). Fractions of the photons: missed (left the scene without a hit), lost (ended on the black back
/// of a one-sided surface before any lit side); of the flux: escaped (left the scene, after bounces too). A scene
/// without light has only seconds_of_setup, threads and photons. `layout`: that section.
/// Failures: more photons than tallies can hold, which a bake would find out at the end.
nlohmann::json checkTime(const CheckInput& input, const nlohmann::json& layout, CheckWarnings& warnings,
                         CheckWarnings& failures);

}  // namespace lucarne
