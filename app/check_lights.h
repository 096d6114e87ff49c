// The lights section of a check: what shines, how much, and whether the numbers look like the units of glTF.
#pragma once

#include "app/check_input.h"

namespace lucarne {

/// sources [{name, kind (point, spot, directional, emissive), intensity [r, g, b], unit (cd, lx, cd/m²), flux_lm [r, g,
/// b], luminous_flux_lm, share}], strongest first; emissive materials are one source each, with triangles, area_m2 (of
/// one side) and textured; flux_lm and luminous_flux_lm of all, punctual_luminous_flux_lm, emissive_luminous_flux_lm.
///
/// Luminous flux is Rec. 709 luminance of the flux in [r, g, b]. The flux of a directional light is what passes through
/// a disc as large as the scene's bounding sphere. Of a textured emitter the sum is the emitter table's, the colour
/// that of 16 points a triangle.
nlohmann::json checkLights(const CheckInput& input, CheckWarnings& warnings);

}  // namespace lucarne
