#include "player/programs.h"

#include "dlm/lobe_width.h"
#include "player/shader_library.h"

namespace lucarne {
namespace {

using Names = std::vector<std::string_view>;

GlProgram build(const std::string& name, const Names& vertex, const Names& fragment,
                const std::vector<std::string>& defines = {}) {
  return makeProgram(name, assembleShader(vertex, defines), assembleShader(fragment, defines));
}

Names fragmentFiles(PassKind pass) {
  switch (pass) {
    case PassKind::direction:
      return {"surface.glsl", "cells.glsl", "members.glsl", "direction_pass.glsl"};
    case PassKind::compose:
      return {"surface.glsl", "compose.glsl", "compose_pass.glsl"};
    case PassKind::view:
      return {"surface.glsl", "cells.glsl", "members.glsl", "compose.glsl", "view_pass.glsl"};
    case PassKind::mask:
      return {"surface.glsl", "mask_pass.glsl"};
    case PassKind::clear:
    case PassKind::singlepass:
      break;
  }
  return {"surface.glsl", "cells.glsl", "compose.glsl", "singlepass.glsl"};
}

void setConstants(GLuint program, const ProgramConstants& c) {
  const auto at = [&](const char* name) { return glGetUniformLocation(program, name); };
  glProgramUniform1f(program, at("cellSharpness"), c.cellSharpness);
  glProgramUniform1f(program, at("capCosine"), c.capCosine);
  glProgramUniform1f(program, at("meanReach"), c.meanReach);
  glProgramUniform1f(program, at("meanBound"), kMeanBound);
  glProgramUniform1f(program, at("mapUnit"), c.mapUnit);
  glProgramUniform1f(program, at("outputScale"), c.outputScale);
  glProgramUniform1f(program, at("metresPerUnit"), c.metresPerUnit);
  glProgramUniform1i(program, at("layersPerStrip"), c.layersPerStrip);
  glProgramUniform2i(program, at("cellTableShape"), c.cellTableNodes, c.cellTableLayers);
}

/// What makes a difference to the shaders of a pass.
ShaderVariant relevant(ShaderVariant variant, PassKind pass) {
  variant.clear = variant.masked = false;
  if (pass == PassKind::mask) return {.textured = variant.textured};
  if (pass == PassKind::compose || pass == PassKind::view) variant.curved = variant.even = false;
  if (pass == PassKind::view || pass == PassKind::direction || pass == PassKind::clear) variant.lambert = false;
  if (pass == PassKind::direction) variant.even = false;
  if (variant.even) variant.curved = false;
  return variant;
}

}  // namespace

Programs::Programs(const ProgramConstants& constants)
    : constants_(constants),
      prepass_(build("prepass", {"camera.glsl", "prepass_vertex.glsl"}, {"prepass_fragment.glsl"})) {}

const ShadingProgram& Programs::shading(PassKind pass, ShaderVariant variant) {
  variant = relevant(variant, pass);
  const auto key = std::tuple(constants_.lobe, pass, variant);
  const auto found = shading_.find(key);
  if (found != shading_.end()) return found->second;

  std::vector<std::string> defines;
  if (variant.curved) defines.emplace_back("CURVED");
  if (variant.textured) defines.emplace_back("TEXTURED");
  if (variant.relief) defines.emplace_back("RELIEF");
  if (variant.even) defines.emplace_back("EVEN");
  if (variant.lambert) defines.emplace_back("LAMBERT");
  if (pass == PassKind::view) defines.emplace_back("VIEW");
  if (pass == PassKind::clear) defines.emplace_back("CLEAR");
  if (constants_.lobe == LobeKind::barsi) defines.emplace_back("LOBE_BARSI");
  if (constants_.lobe == LobeKind::sample) defines.emplace_back("LOBE_SAMPLE");
  if (constants_.means) defines.emplace_back("MEAN_CELLS");
  if (constants_.means && constants_.lobe == LobeKind::cell) defines.emplace_back("MEAN_LIGHT");
  const Names files = fragmentFiles(pass);
  ShadingProgram made{build(std::string(files.back()), {"camera.glsl", "surface_vertex.glsl"}, files, defines), -1, -1,
                      -1};
  setConstants(made.program.get(), constants_);
  made.materialIndex = glGetUniformLocation(made.program.get(), "materialIndex");
  made.direction = glGetUniformLocation(made.program.get(), "direction");
  made.view = glGetUniformLocation(made.program.get(), "view");
  return shading_.emplace(key, std::move(made)).first->second;
}

}  // namespace lucarne
