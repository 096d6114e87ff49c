// The shading programs, in the variants that the scene needs; compiled at first use.
#pragma once

#include <compare>
#include <map>
#include <utility>

#include "player/gl_objects.h"
#include "player/render_options.h"

namespace lucarne {

enum class PassKind {
  singlepass,  // loops over the side's directions and composes
  direction,   // adds one direction
  compose,     // of what the direction passes added
  view,        // shows what the maps hold
};

/// What the shaders of a batch must do.
struct ShaderVariant {
  bool curved = false;    // cells are looked up by normal (needsCellTable)
  bool textured = false;  // the material has a texture
  friend auto operator<=>(const ShaderVariant&, const ShaderVariant&) = default;
};

/// A linked program and where its uniforms are (−1: it has none of that name).
struct ShadingProgram {
  GlProgram program;
  GLint materialIndex = -1, direction = -1, view = -1;
};

/// Uniforms that stay the same for the whole life of the maps.
struct ProgramConstants {
  float cellSharpness = 1, mapUnit = 1, outputScale = 1;
  float metresPerUnit = 1;  // of local lengths
  int layersPerStrip = 1, cellTableNodes = 1, cellTableLayers = 1;
  LobeKind lobe = LobeKind::cell;
  float capCosine = 1;  // of barsi
};

class Programs {
 public:
  explicit Programs(const ProgramConstants& constants);  // needs a current context

  const GlProgram& prepass() const { return prepass_; }
  const ShadingProgram& shading(PassKind pass, ShaderVariant variant);

 private:
  ProgramConstants constants_;
  GlProgram prepass_;
  std::map<std::pair<PassKind, ShaderVariant>, ShadingProgram> shading_;
};

}  // namespace lucarne
