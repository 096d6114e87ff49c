// glTF 2.0 files, .glb and .gltf, to a Scene (scene.h). Files are taken as hostile: everything is validated before it
// is used (gltf_validate.h), and any file gives either a scene or an InputError that names the file and the place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "tracer/scene/scene.h"

namespace lucarne {

/// The default scene of the file. What it has and a Scene has not is named in Scene::leftOut; buffers and images may
/// lie in the file, in data URIs, or in files of the same folder. A scene without triangles is an InputError.
Scene readGltf(const std::filesystem::path& path);

/// The same from memory; `name` stands for the file in errors. It may refer to no other file.
Scene readGlb(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace lucarne
