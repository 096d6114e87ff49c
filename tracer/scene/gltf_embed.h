// Images of other files moved into a document.
#pragma once

#include "tracer/scene/gltf_document.h"

namespace lucarne {

/// Every image of `source` that has a URI and bytes becomes a buffer view of `document`, whose images are those of
/// `source`.
void embedImages(const GltfSource& source, GltfDocument& document);

}  // namespace lucarne
