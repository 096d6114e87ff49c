// A glTF file as read: the whole JSON document and all bytes that it refers to, so that it can be written again with
// nothing lost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tracer/scene/gltf_json.h"

namespace lucarne {

struct GltfSource {
  std::string name;  // for error texts
  Json json;
  std::vector<std::vector<std::uint8_t>> buffers;  // one a JSON buffer, exactly byteLength bytes
  /// One a JSON image: its encoded bytes where they come from a URI (empty when that file is missing, or when the image
  /// lies in a buffer view).
  std::vector<std::vector<std::uint8_t>> images;

  Place place() const { return Place(name); }
  /// A top-level array of objects (checked on loading); empty where the document has none.
  const Json& list(const char* key) const;
  /// Encoded bytes of an image, wherever they lie; empty when there are none.
  std::span<const std::uint8_t> imageBytes(std::uint32_t image) const;
  /// Bytes of a buffer view.
  std::span<const std::uint8_t> viewBytes(std::uint32_t view) const;
};

/// Container, JSON, references, bounds and node graph checked (gltf_validate.h), buffers and images loaded. All
/// failures are InputErrors that name the file and the place; a missing image file is none.
std::shared_ptr<const GltfSource> loadGltfSource(const std::filesystem::path& path);
/// .glb bytes, or .gltf text, from memory. It may refer to no other file.
std::shared_ptr<const GltfSource> loadGltfSource(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace lucarne
