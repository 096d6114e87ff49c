// A glTF file and all that it refers to as one GLB: what travels with a bake from machine to machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Buffers and images of other files move into the one binary chunk; nothing else changes, and nothing is dropped but
/// bytes that no buffer view holds. The same document gives the same bytes wherever its files lie, and packing the
/// result again gives it once more. An image file that is missing stays missing.
std::vector<std::uint8_t> packGltf(const GltfSource& source);

/// A scene as it is read from its packed bytes: the same on every machine that has them.
struct PackedScene {
  std::vector<std::uint8_t> glb;
  Scene scene;
};
/// Failures as in readGltf().
PackedScene readPacked(const std::filesystem::path& path);

}  // namespace lucarne
