#include "player/draw_state.h"

namespace lucarne {
namespace {

constexpr GLuint kMaterialUnits[] = {4, 5, 6, 10};  // base colour, metallic-roughness, emission, normal (surface.glsl)

}  // namespace

void DrawState::reset() { *this = {}; }

void DrawState::forgetBindings() {
  const StateCounts counts = counts_;
  const View view = view_;
  const int words = words_;
  reset();
  counts_ = counts;
  setView(view, words);
}

void DrawState::useProgram(const ShadingProgram& program) {
  if (program_ == &program) return;
  program_ = &program;
  glUseProgram(program.program.get());
  if (material_ != ~0u) glUniform1i(program.materialIndex, static_cast<GLint>(material_));
  if (program.view >= 0) glUniform3i(program.view, static_cast<GLint>(view_.kind), view_.psi, words_);
  if (direction_ >= 0) glUniform2i(program.direction, direction_, words_);
}

void DrawState::setDirection(int psi, int words) {
  if (direction_ == psi) return;
  direction_ = psi;
  words_ = words;
  ++counts_.directionSwitches;
  if (program_ != nullptr) glUniform2i(program_->direction, psi, words);
}

void DrawState::setView(View view, int words) {
  view_ = view;
  words_ = words;
}

void DrawState::useMaterial(std::uint32_t material, const MaterialTextures* textures) {
  if (textures != nullptr) {
    bindTexture(0, textures->baseColor);
    bindTexture(1, textures->metallicRoughness);
    bindTexture(2, textures->emissive);
    bindTexture(3, textures->normal);
  }
  if (material_ == material) return;
  material_ = material;
  ++counts_.materialSwitches;
  glUniform1i(program_->materialIndex, static_cast<GLint>(material));
}

void DrawState::bindTexture(GLuint unit, GLuint texture) {
  if (textures_[unit] == texture) return;
  textures_[unit] = texture;
  ++counts_.textureSwitches;
  glBindTextureUnit(kMaterialUnits[unit], texture);
}

}  // namespace lucarne
