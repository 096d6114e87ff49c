// The shading programs, in the variants that the scene needs; compiled at first use.
#pragma once

#include <map>
#include <tuple>

#include "player/gl_objects.h"
#include "player/render_options.h"

namespace lucarne {

enum class PassKind {
  singlepass,  // loops over the side's directions and composes
  direction,   // adds one direction
  compose,     // of what the direction passes added
};

/// A linked program and where its uniforms are (−1: it has none of that name).
struct ShadingProgram {
  GlProgram program;
  GLint materialIndex = -1, direction = -1;
};

/// Uniforms that stay the same for the whole life of the maps.
struct ProgramConstants {
  float cellSharpness = 1, mapUnit = 1, outputScale = 1;
  int layersPerStrip = 1, cellTableNodes = 1, cellTableLayers = 1;
  LobeKind lobe = LobeKind::cell;
  float capCosine = 1;  // of barsi
};

class Programs {
 public:
  explicit Programs(const ProgramConstants& constants);  // needs a current context

  const GlProgram& prepass() const { return prepass_; }
  const ShadingProgram& shading(PassKind pass, bool curved, bool textured);

 private:
  ProgramConstants constants_;
  GlProgram prepass_;
  std::map<std::tuple<PassKind, bool, bool>, ShadingProgram> shading_;
};

}  // namespace lucarne
