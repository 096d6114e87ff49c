// Directional maps from their file to the GPU, page by page.
#pragma once

#include "player/gl_objects.h"
#include "player/map_source.h"
#include "player/map_tables.h"

namespace lucarne {

/// The texture of `tables` with the values of the file as they are (their scale is left to the shader). All threads decode, this
/// one sends. The source must have a file. Needs a current context.
GlTexture streamDirectional(const MapSource& source, const MapTables& tables, LightMapFormat format);

}  // namespace lucarne
