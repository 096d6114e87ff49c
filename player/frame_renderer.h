// Draws frames of one scene with its light maps; needs a current OpenGL 4.5 context for its whole life: one, or first one
// that it is made in and then another that shares its objects. The same code serves the window and the offscreen pictures.
#pragma once

#include <memory>
#include <optional>

#include "player/map_renderer.h"
#include "player/render_options.h"
#include "player/sky_pass.h"

namespace lucarne {

struct FrameView {
  Camera camera;
  double shiftX = 0, shiftY = 0;  // of the whole image, in pixels (for supersampling)
  View view{};
};

class FrameRenderer {
 public:
  /// `scene` and `source` are needed only here. `outputScale`: target units per cd/m².
  FrameRenderer(const Scene& scene, const MapSource& source, LightMapFormat format, float outputScale = 1.f,
                LobeKind lobe = LobeKind::cell);

  /// Fills target.color with outputScale · cd/m², or what the view says (light scaled likewise); black where nothing
  /// is.
  void draw(const FrameView& view, RendererKind renderer, const FrameTarget& target);

  /// Draws something of each material once, out of sight, so that the driver has compiled what frames with that renderer
  /// and view need. In another context than the one that draws later, which shares its objects.
  void warmUpBeside(RendererKind renderer, const View& view);
  /// What drivers compile for each context alone: the same for one of warmUpSteps() materials, in the context that draws.
  void warmUp(RendererKind renderer, const View& view, std::size_t step);
  std::size_t warmUpSteps() const { return scene_.list.batches.size(); }

  /// Shown where there is no surface, instead of black; equirectangular, cd/m² (sky_pass.h).
  void setSky(const ImageRgb& image);

  /// Programs for it are made at the first frame that needs them.
  void setLobe(LobeKind lobe) { programs_.setLobe(lobe); }
  float outputScale() const { return outputScale_; }
  const GpuMaps& maps() const { return maps_; }

  /// Of the last frame drawn; times are left to the caller.
  const RenderStats& stats() const { return stats_; }

 private:
  void drawSmall(RendererKind renderer, const View& view, const std::vector<std::uint8_t>& visible);
  void uploadCamera(const FrameView& view, const FrameTarget& target) const;
  void prepass(const DrawContext& context, const FrameTarget& target, bool withClear);
  void drawRuns(const FrameView& view, MapRenderer& shading, const std::vector<std::uint8_t>& visible,
                const FrameTarget& target);
  void drawBehindAndBefore(const DrawContext& context, Vec3d eye, const FrameTarget& target);
  MapRenderer& rendererFor(const View& view, RendererKind renderer);
  void bindCommon(const FrameTarget& target);

  GpuMaps maps_;
  GpuScene scene_;
  Programs programs_;
  GlBuffer camera_;
  float outputScale_;
  std::optional<SkyPass> sky_;
  VertexRanges ranges_;
  std::unique_ptr<MapRenderer> singlepass_, multipass_, views_;
  DrawState state_;
  RenderStats stats_;
};

}  // namespace lucarne
