// A glTF document under construction: JSON and one binary chunk. Accessors and buffer views that nothing refers to any
// more give their places to new ones, so that no reference to the others has to change.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "tracer/scene/gltf_references.h"
#include "tracer/scene/gltf_source.h"

namespace lucarne {

class GltfDocument {
 public:
  /// Takes over the buffer views of `source` that `used` says are in use, with their bytes.
  GltfDocument(Json json, const GltfSource& source, const UsedReferences& used);

  Json& json() { return json_; }

  /// Bytes of `stride` each (0: no stride is given), for vertices (34962), indices (34963) or neither (0).
  std::uint32_t addView(std::span<const std::uint8_t> bytes, std::uint32_t stride, std::uint32_t target);
  std::uint32_t addAccessor(Json accessor);
  /// Texture coordinates that are all zero and take no room.
  std::uint32_t zeroUvAccessor(std::uint64_t count);

  /// GLB bytes.
  std::vector<std::uint8_t> finish();

 private:
  std::uint32_t place(const char* key, std::vector<std::uint32_t>& freePlaces, Json object);
  void dropFreePlaces(const char* key, std::vector<std::uint32_t>& freePlaces, const Json& filler);
  std::uint64_t append(std::span<const std::uint8_t> bytes);

  Json json_;
  std::vector<std::uint8_t> bin_;
  std::vector<std::uint32_t> freeAccessors_, freeViews_;  // decreasing: the lowest is taken first
  std::map<std::uint64_t, std::uint32_t> zeroUv_;         // by count
};

}  // namespace lucarne
