// The GLSL files of player/shaders, embedded at build time, and how programs are glued from them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lucarne {

struct ShaderFile {
  std::string_view name, text;
};

/// Every file of player/shaders (generated).
std::span<const ShaderFile> shaderFiles();

/// "#version", one "#define NAME 1" for each of `defines` ("NAME" or "NAME value"), then the named files in order, each
/// with a #line directive, so that compile errors point into the file. Throws std::logic_error for an unknown name.
std::string assembleShader(std::span<const std::string_view> names, std::span<const std::string> defines);

}  // namespace lucarne
