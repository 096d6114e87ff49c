#include "player/shader_library.h"

#include <algorithm>
#include <stdexcept>

namespace lucarne {
namespace {

std::string_view textOf(std::string_view name) {
  const auto files = shaderFiles();
  const auto found = std::find_if(files.begin(), files.end(), [&](const ShaderFile& f) { return f.name == name; });
  if (found == files.end()) throw std::logic_error("no shader file " + std::string(name));
  return found->text;
}

}  // namespace

std::string assembleShader(std::span<const std::string_view> names, std::span<const std::string> defines) {
  std::string source = "#version 450 core\n";
  for (const std::string& define : defines) source += "#define " + define + "\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    source += "#line 1 " + std::to_string(i) + "\n";
    source += textOf(names[i]);
  }
  return source;
}

}  // namespace lucarne
