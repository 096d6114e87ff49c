// The irradiance atlas: one rectangle a chart, shared by its front and back, and the texture coordinates into it.
#pragma once

#include "dlm/charts.h"
#include "dlm/light_maps.h"
#include "dlm/texel_layout.h"
#include "tracer/scene/gltf_writer.h"

namespace lucarne {

/// Packs the charts of `maps` into one atlas (sets atlasX, atlasY, atlasWidth, atlasHeight) and returns the texture
/// coordinates of every triangle corner in it.
AtlasUv placeInAtlas(const ChartSet& charts, const TexelLayout& layout, LightMaps& maps);

}  // namespace lucarne
