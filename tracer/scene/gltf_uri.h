// URIs of buffers and images: data: or a file in the scene's own folder, nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "tracer/scene/gltf_json.h"

namespace lucarne {

bool isDataUri(std::string_view uri);

/// data:[type][;parameter…];base64,… to bytes. `mimeType` gets the type if not null.
std::vector<std::uint8_t> decodeDataUri(std::string_view uri, const Place& place, std::string* mimeType = nullptr);

/// The file that a relative URI names, percent-decoded. Refuses absolute paths, schemes, "..", backslashes and control
/// characters: a scene from elsewhere must not reach the rest of the disk.
std::filesystem::path confinedPath(const std::filesystem::path& folder, std::string_view uri, const Place& place);

}  // namespace lucarne
