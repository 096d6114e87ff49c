// Materials, textures and images of a glTF document.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tracer/scene/gltf_textures.h"

namespace lucarne {

struct GltfMaterials {
  std::vector<Material> materials;  // one a JSON material, then the default material
  std::vector<UvSlots> uvSlots;     // likewise
  std::vector<Texture> textures;    // one a JSON texture
};

/// Every texture use of a material, absent ones too.
std::array<const TextureUse*, 7> textureUses(const Material& material);

/// Factors outside their range are brought into it and `leftOut` says so; negative or infinite light is an InputError.
/// A normal map whose texture has no image in the file is dropped.
GltfMaterials readMaterials(const GltfSource& source, std::vector<std::string>& leftOut);

/// Decodes the images that `materials` use; white, 1 × 1, for the others and for those that cannot be decoded, which
/// `leftOut` names. White would be no normal map: materials lose theirs where its image cannot be decoded.
std::vector<Image> readImages(const GltfSource& source, GltfMaterials& materials, std::vector<std::string>& leftOut);

}  // namespace lucarne
