// Light maps as OpenGL objects.
#pragma once

#include "dlm/light_maps.h"
#include "player/gl_objects.h"
#include "player/map_source.h"
#include "player/map_tables.h"
#include "player/render_options.h"

namespace lucarne {

struct GpuMaps {
  GlTexture directional;  // 2D array
  GlTexture means;        // 2D array, at the same places: (m − ψ)/meanReach as RGB10_A2; one empty texel where there are none
  GlTexture irradiance;   // 2D array, 32-bit float, lx
  GlTexture statistics;   // 2D array, likewise: photons, relative error
  GlTexture cellTable;    // 2D array; one empty texel where no chart needs it
  GlBuffer sides, cells, memberBits, directions;
  bool hasMeans = false;
  float meanReach = 0;
  int cellTableNodes = 1, cellTableLayers = 1;
  int layersPerStrip = 1, wordsPerSide = 1;
  std::vector<LayeredPlace> places;  // by side: of its first stored map in `directional`
  float mapUnit = 1;                                  // lx per stored unit of `directional`, a power of two
  float cellSharpness = 1;                            // λ of a cell
  std::uint64_t lightMapBytes = 0, textureBytes = 0;  // the directional maps and their means; all textures here
};

/// Limits of the current context.
TextureLimits textureLimits();

/// Error(outOfResource) when the maps do not fit, InputError for a damaged file. Needs a current context.
GpuMaps uploadMaps(const MapSource& source, LightMapFormat format);

}  // namespace lucarne
