// The shading programs, in the variants that the scene needs; compiled at first use.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <tuple>

#include "player/gl_objects.h"
#include "player/render_options.h"

namespace lucarne {

enum class PassKind {
  singlepass,  // loops over the side's directions and composes
  direction,   // adds one direction
  compose,     // of what the direction passes added
  mask,        // depth pre-pass of what has holes
  clear,       // composed over what is behind it
  view,        // shows what the maps hold
};

/// What the shaders of a batch must do.
struct ShaderVariant {
  bool clear = false;     // blended or glass: drawn last, from the back to the front
  bool masked = false;    // has holes
  bool curved = false;    // cells are looked up by normal (needsCellTable)
  bool textured = false;  // the material has a texture (other than a normal map)
  bool relief = false;    // has a normal map
  bool even = false;      // the charts have irradiance only
  bool lambert = false;   // no coat
  friend auto operator<=>(const ShaderVariant&, const ShaderVariant&) = default;
};

/// Textures that a material of the variant binds.
constexpr std::uint64_t texturesOf(const ShaderVariant& v) { return v.textured || v.relief ? 4 : 0; }

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
  bool means = false;   // the maps have mean directions
  float meanReach = 0;
};

class Programs {
 public:
  explicit Programs(const ProgramConstants& constants);  // needs a current context

  void setLobe(LobeKind lobe) { constants_.lobe = lobe; }
  const GlProgram& prepass() const { return prepass_; }
  const ShadingProgram& shading(PassKind pass, ShaderVariant variant);

 private:
  ProgramConstants constants_;
  GlProgram prepass_;
  std::map<std::tuple<LobeKind, PassKind, ShaderVariant>, ShadingProgram> shading_;
};

}  // namespace lucarne
