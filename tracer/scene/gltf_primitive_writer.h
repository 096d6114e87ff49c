// One triangle primitive with its place in the atlas, all attributes gathered for the split vertices.
#pragma once

#include "tracer/scene/gltf_document.h"
#include "tracer/scene/gltf_vertex_split.h"

namespace lucarne {

/// `primitive` is the JSON to change: its attributes, indices and targets are put in place of what `original` refers to
/// in the source (the same primitive, with TEXCOORD_1 already free for the atlas).
void writePrimitive(const GltfSource& source, const Json& original, const SplitVertices& split, GltfDocument& document,
                    Json& primitive);

/// Adds all-zero sets below the highest TEXCOORD_n: sets must be numbered without gaps.
void fillTexcoordGaps(Json& attributes, std::uint64_t vertexCount, GltfDocument& document);

}  // namespace lucarne
