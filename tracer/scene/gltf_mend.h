// Changes to a document's JSON that make room for the atlas and mend what stricter readers refuse; no bytes are
// touched.
#pragma once

#include "tracer/scene/gltf_json.h"

namespace lucarne {

/// Where a material uses TEXCOORD_1, moves that set to the first number that no primitive and no material uses, in all
/// primitives and materials.
void freeTexcoord1(Json& json);

/// Removes references of textures to images that are not there, brings emissive factors over 1 into range (the rest
/// goes into KHR_materials_emissive_strength; the product keeps its bits), and drops the compressed doubles of plain
/// data.
void mendDocument(Json& json);

}  // namespace lucarne
