// Materials, textures and images of a glTF document.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The TEXCOORD sets that Scene::uv0 and uv1 hold for the triangles of one material.
using UvSlots = std::array<std::uint32_t, 2>;

struct GltfMaterials {
  std::vector<Material> materials;  // one a JSON material, then the default material
  std::vector<UvSlots> uvSlots;     // likewise
  std::vector<Texture> textures;    // one a JSON texture
};

/// Factors outside their range are brought into it and `leftOut` says so; negative or infinite light is an InputError.
GltfMaterials readMaterials(const GltfSource& source, std::vector<std::string>& leftOut);

/// Decodes the images that `materials` use; white, 1 × 1, for the others and for those that cannot be decoded, which
/// `leftOut` names.
std::vector<Image> readImages(const GltfSource& source, const GltfMaterials& materials,
                              std::vector<std::string>& leftOut);

}  // namespace lucarne
