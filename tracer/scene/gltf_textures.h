// Textures of a glTF document, and how a material uses them.
#pragma once

#include <array>

#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The TEXCOORD sets that Scene::uv0 and uv1 hold for the triangles of one material.
using UvSlots = std::array<std::uint32_t, 2>;

/// `index` of the document's textures. Its image is kNone where it names none of the file's.
Texture readTexture(const GltfSource& source, std::uint32_t index);

/// Reads the texture uses of one material and gives its sets of texture coordinates their slots: slot 0 is set 0, slot
/// 1 the first other set that is asked for. A third set gets slot 1 too, so those that matter most are read first.
class TextureUseReader {
 public:
  /// `textures`: how many the document has.
  explicit TextureUseReader(std::size_t textures) : textures_(textures) {}

  /// The texture info `key` of `parent`; false where it is absent.
  TextureUse read(const Json& parent, const char* key, const Place& place);

  UvSlots slots() const { return slots_; }
  bool thirdUvSet() const { return thirdUvSet_; }

 private:
  std::uint8_t slotOf(std::uint64_t set);

  std::size_t textures_;
  UvSlots slots_{0, 1};
  int otherSet_ = -1;  // the set other than 0 that slot 1 holds
  bool thirdUvSet_ = false;
};

}  // namespace lucarne
