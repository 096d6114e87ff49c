// The two ways to draw a frame from light maps. Both start from the same depth pre-pass and end in the same image.
#pragma once

#include <memory>
#include <vector>

#include "player/draw_state.h"
#include "player/frame_target.h"
#include "player/map_upload.h"
#include "player/programs.h"
#include "player/scene_upload.h"

namespace lucarne {

/// All that is drawn, as it lies on the GPU.
struct DrawContext {
  const GpuScene& scene;
  const GpuMaps& maps;
  Programs& programs;
};

class MapRenderer {
 public:
  virtual ~MapRenderer() = default;
  /// Shades into target.shading after the pre-pass has filled depth and owners; counts what it changes.
  virtual void shade(const DrawContext& context, const FrameTarget& target, DrawState& state) = 0;
  /// What the same image would cost without any sorting: chart by chart, each with all its directions.
  virtual StateCounts unsorted() const = 0;
};

/// One draw a material and variant; each fragment loops over the directions of its side.
std::unique_ptr<MapRenderer> makeSinglepass(const DrawList& list);

/// Shows what the maps hold (FrameView::view) instead of the light toward the eye.
std::unique_ptr<MapRenderer> makeViewRenderer(const DrawList& list);

/// The paper's: one additive pass a direction over the charts that have it, then one pass that composes. The direction
/// changes as rarely as possible, then the program, then the material; batches are walked to and fro so that each
/// direction starts with the material the last one ended with.
std::unique_ptr<MapRenderer> makeMultipass(const DrawList& list, const LightMaps& maps);

}  // namespace lucarne
