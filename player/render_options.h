// What a picture is made with, and what making it took.
#pragma once

#include <cstdint>
#include <string>

#include "player/view_kind.h"

namespace lucarne {

enum class RendererKind {
  singlepass,  // one pass; each fragment walks its side's own directions
  multipass,   // the paper's: one additive pass a direction, then a pass that composes
  pathtraced,  // the truth, by the path tracer: no light maps, no GPU
};

enum class LightMapFormat {
  half,     // 8 bytes a texel
  rgb9e5,   // 4 bytes
  float32,  // 16 bytes: for tests of exactness
};

/// How the reflection lobe is weighed against the light of a cell; lobe.h has the formulas.
enum class LobeKind {
  cell,    // averaged over the cell and normalised over the set
  barsi,   // averaged over a cap by a closed form, not normalised
  sample,  // in the middle of the cell, not normalised
};

struct RenderOptions {
  int width = 1280, height = 720;
  RendererKind renderer = RendererKind::singlepass;
  LightMapFormat format = LightMapFormat::half;
  LobeKind lobe = LobeKind::cell;
  View view{};
  std::uint64_t gpuMemory = 0;  // bytes for light maps; 0: what the driver says is free
  int supersamples = 1;         // pictures without a window: so many samples a pixel, each way
};

/// State changes of one frame.
struct StateCounts {
  std::uint64_t draws = 0;
  std::uint64_t directionSwitches = 0;  // changes of the light direction
  std::uint64_t textureSwitches = 0;    // bindings of another texture
  std::uint64_t materialSwitches = 0;
};

struct RenderStats {
  StateCounts counts;
  StateCounts unsorted;  // the same frame drawn chart by chart, direction by direction, nothing remembered
  std::uint64_t charts = 0, visibleCharts = 0;  // runs of triangles of one chart; of them those that may be in sight
  std::uint64_t textureBytes = 0;               // light maps, tables and material textures
  std::uint64_t lightMapBytes = 0;              // of them the directional maps
  int directions = 0;                           // |Ω|
  std::string driver;                           // GL_RENDERER
  double loadSeconds = 0, frameSeconds = 0;
};

}  // namespace lucarne
