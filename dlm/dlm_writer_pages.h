// Light maps laid out as the layers of irradiance.exr, directional.exr and moments.exr.
#pragma once

#include <vector>

#include "base/image_file.h"
#include "dlm/light_maps.h"
#include "dlm/manifest.h"

namespace lucarne {

/// "front", "back" where a back side is lit, and the statistics of each. The gutters between the charts' rectangles
/// repeat the nearest texel of a rectangle, so that bilinear lookup and the first mipmaps are right in any engine.
std::vector<ExrLayer> irradianceLayers(const LightMaps& maps);

/// Packs the stored directional maps, those of one ψ together, and tells where each goes; scale is left 1.
/// `neutralApart`: maps whose texels all have three equal components go to pages of their own.
DirectionalPages packDirectional(const LightMaps& maps, bool neutralApart);

/// In pages.format, divided by its scales.
std::vector<ExrLayer> directionalLayers(const LightMaps& maps, const DirectionalPages& pages);

/// Mean directions on pages of the same places and names, in codes of packMean(). Empty where there are none.
std::vector<ExrLayer> meanLayers(const LightMaps& maps, const DirectionalPages& pages);

/// The power of two that brings the largest value into [2^14, 2^15) when divided by it: half's whole range below is
/// then there for the small ones. 1 when all is zero.
double directionalScale(const LightMaps& maps);

}  // namespace lucarne
