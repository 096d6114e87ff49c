#include "player/texture_upload.h"

#include <bit>

#include "base/error.h"
#include "player/gl_context.h"

namespace lucarne {
namespace {

GLint wrapMode(Wrap wrap) {
  switch (wrap) {
    case Wrap::mirroredRepeat:
      return GL_MIRRORED_REPEAT;
    case Wrap::clampToEdge:
      return GL_CLAMP_TO_EDGE;
    case Wrap::repeat:
      break;
  }
  return GL_REPEAT;
}

/// Software drivers pay dearly for each sample along the way.
float usefulAnisotropy() {
  if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) return 1;
  GLfloat largest = 1;
  glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &largest);
  return std::min(largest, isSoftwareDriver(driverName()) ? 1.f : 8.f);
}

}  // namespace

SceneTextures::SceneTextures(const Scene& scene) : anisotropy_(usefulAnisotropy()) {
  white_ = makeTexture({GL_TEXTURE_2D, GL_RGBA8, 1, 1, 1, 1});
  const std::uint32_t one = 0xffffffffu;
  glTextureSubImage2D(white_.get(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &one);
  for (const Material& m : scene.materials) {
    byMaterial_.push_back({upload(scene, m.baseColorTexture, true), upload(scene, m.metallicRoughnessTexture, false),
                           m.emits() ? upload(scene, m.emissiveTexture, true) : white_.get(),
                           upload(scene, m.normalTexture, false)});
  }
}

GLuint SceneTextures::upload(const Scene& scene, const TextureUse& use, bool srgb) {
  if (!use) return white_.get();
  LUCARNE_CHECK_LT(use.texture, scene.textures.size());
  const Texture& source = scene.textures[use.texture];
  if (source.image == kNone) return white_.get();
  const auto found = textures_.find({use.texture, srgb});
  if (found != textures_.end()) return found->second.get();

  const Image& image = scene.images[source.image];
  if (image.width < 1 || image.height < 1) return white_.get();
  const int levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
  GlTexture texture =
      makeTexture({GL_TEXTURE_2D, GLenum(srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8), levels, image.width, image.height, 1});
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.get(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glGenerateTextureMipmap(texture.get());
  glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, wrapMode(source.wrapS));
  glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_T, wrapMode(source.wrapT));
  glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, source.nearest ? GL_NEAREST : GL_LINEAR);
  if (anisotropy_ > 1) glTextureParameterf(texture.get(), GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy_);
  bytes_ += static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height) * 16 / 3;
  return textures_.emplace(std::pair(use.texture, srgb), std::move(texture)).first->second.get();
}

}  // namespace lucarne
