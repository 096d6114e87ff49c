// The GLB container: a header, one JSON chunk, and one BIN chunk that may be absent.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/scene/gltf_json.h"

namespace lucarne {

/// Views into the file's bytes.
struct GlbChunks {
  std::string_view json;
  std::span<const std::uint8_t> bin;
  bool hasBin = false;
};

bool isGlb(std::span<const std::uint8_t> bytes);

/// Bytes after the declared length and unknown chunks after the first are passed over, as the specification wants;
/// anything else out of order is an InputError.
GlbChunks parseGlb(std::span<const std::uint8_t> bytes, const Place& file);

/// Error(failed) where the result would pass the 4 GiB that the format can say.
std::vector<std::uint8_t> packGlb(const std::string& json, std::span<const std::uint8_t> bin);

}  // namespace lucarne
