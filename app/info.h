// What a file is and what is in it, for people and as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace lucarne {

/// A .dlm folder, a .part (read whole and checked), a scene (.glb, .gltf) or an image (.exr, .hdr). Always has "kind" and "path". InputError for
/// anything else.
nlohmann::json describe(const std::filesystem::path& path);

/// How a .part or a .dlm stands to a scene file as it is now: "matches" (the light would be the same), "same_file", and
/// "differences" in words. InputError where `path` is neither.
nlohmann::json compareWithScene(const std::filesystem::path& path, const std::filesystem::path& scene);

/// The same as indented lines "key: value".
std::string toText(const nlohmann::json& description);

}  // namespace lucarne
