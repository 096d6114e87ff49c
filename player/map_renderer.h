// The two ways to draw a frame from light maps. Both start from the same depth pre-pass and end in the same image.
#pragma once

#include <memory>
#include <vector>

#include "player/draw_state.h"
#include "player/frame_target.h"
#include "player/map_upload.h"
#include "player/programs.h"
#include "player/scene_upload.h"
#include "player/vertex_ranges.h"

namespace lucarne {

/// All that is drawn, as it lies on the GPU.
struct DrawContext {
  const GpuScene& scene;
  const GpuMaps& maps;
  Programs& programs;
  const std::vector<std::uint8_t>& visible;  // by run of the list
};

class MapRenderer {
 public:
  virtual ~MapRenderer() = default;
  /// Shades into target.shading after the pre-pass has filled depth and owners; counts what it changes. Clear surfaces
  /// are left out.
  virtual void shade(const DrawContext& context, const FrameTarget& target, DrawState& state) = 0;
  /// What the same image would cost without any sorting: chart by chart, each with all its directions.
  virtual StateCounts unsorted(const DrawContext& context) const = 0;
};

/// One draw a batch; each fragment loops over the directions of its side.
std::unique_ptr<MapRenderer> makeSinglepass();

/// Shows what the maps hold (FrameView::view) instead of the light toward the eye, clear surfaces like any other.
std::unique_ptr<MapRenderer> makeViewRenderer();

/// The paper's: one additive pass a direction over the charts that have it, then one pass that composes. The direction
/// changes as rarely as possible, then the program, then the material; batches are walked to and fro so that each
/// direction starts with the material the last one ended with.
std::unique_ptr<MapRenderer> makeMultipass(const DrawList& list, const LightMaps& maps);

/// Draws the visible runs of a batch with one call, if any; counts what it changes.
void drawBatch(const DrawContext& context, PassKind pass, const Batch& batch, VertexRanges& scratch, DrawState& state);
/// Makes the program and the material of a batch current.
void useBatch(const DrawContext& context, PassKind pass, const Batch& batch, DrawState& state);

/// Composes the clear surfaces over target.shading from the back to the front, by triangles, behind none that is solid.
/// Both renderers end with it: what is seen through a surface cannot be summed up by direction.
void drawClear(const DrawContext& context, Vec3d eye, const FrameTarget& target, DrawState& state);

}  // namespace lucarne
