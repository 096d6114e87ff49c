// The scene's own textures as OpenGL objects.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "player/gl_objects.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Texture names for one material; untextured slots hold a white texel.
struct MaterialTextures {
  GLuint baseColor = 0, metallicRoughness = 0, emissive = 0, normal = 0;
};

class SceneTextures {
 public:
  /// Only what materials use. With mipmaps, and anisotropic filters where the driver has them; sRGB ones are decoded
  /// before filtering. Needs a current context.
  explicit SceneTextures(const Scene& scene);

  const MaterialTextures& of(std::uint32_t material) const { return byMaterial_[material]; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  GLuint upload(const Scene& scene, const TextureUse& use, bool srgb);

  float anisotropy_;
  GlTexture white_;
  std::map<std::pair<std::uint32_t, bool>, GlTexture> textures_;  // (texture, sRGB)
  std::vector<MaterialTextures> byMaterial_;
  std::uint64_t bytes_ = 0;
};

}  // namespace lucarne
