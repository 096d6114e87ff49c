#include "player/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include "player/frustum.h"
#include "player/lobe.h"

namespace lucarne {
namespace {

/// The near plane, local units: 0.2 mm in a room of five metres. Depth is reversed floats, which keep their precision.
constexpr double kNear = 1e-4;

struct CameraBlock {  // camera.glsl, std140
  float eye[4], right[4], up[4], back[4], projection[4];
};

void set(float (&to)[4], Vec3d v, double w = 0) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(v[i]);
  to[3] = static_cast<float>(w);
}

ProgramConstants constantsOf(const GpuMaps& maps, float outputScale, LobeKind lobe, int directionCount,
                             double metresPerUnit) {
  ProgramConstants c;
  c.cellSharpness = maps.cellSharpness;
  c.mapUnit = maps.mapUnit;
  c.outputScale = outputScale;
  c.metresPerUnit = static_cast<float>(metresPerUnit);
  c.layersPerStrip = maps.layersPerStrip;
  c.cellTableNodes = maps.cellTableNodes;
  c.cellTableLayers = maps.cellTableLayers;
  c.lobe = lobe;
  c.capCosine = capCosine(directionCount);
  c.means = maps.hasMeans;
  c.meanReach = maps.meanReach;
  return c;
}

/// State that no pass changes back.
void setFixedState(const FrameTarget& target) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glViewport(0, 0, target.width, target.height);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace

FrameRenderer::FrameRenderer(const Scene& scene, const MapSource& source, LightMapFormat format, float outputScale,
                             LobeKind lobe)
    : maps_(uploadMaps(source, format)),
      scene_(scene, source.maps),
      programs_(constantsOf(maps_, outputScale, lobe, source.maps.directionCount, scene.frame.scale)),
      camera_(makeBuffer(std::as_bytes(std::span<const CameraBlock, 1>(std::array<CameraBlock, 1>{})),
                         GL_DYNAMIC_STORAGE_BIT)),
      outputScale_(outputScale),
      singlepass_(makeSinglepass()),
      multipass_(makeMultipass(scene_.list, source.maps)),
      views_(makeViewRenderer()) {
  stats_.textureBytes = maps_.textureBytes + scene_.textures.bytes();
  stats_.lightMapBytes = maps_.lightMapBytes;
  stats_.directions = source.maps.directionCount;
}

void FrameRenderer::uploadCamera(const FrameView& view, const FrameTarget& target) const {
  const Camera& c = view.camera;
  const double y = 1 / std::tan(c.yfov / 2), x = y * target.height / target.width;
  CameraBlock block{};
  set(block.eye, c.position, kNear);
  set(block.right, c.right);
  set(block.up, c.up);
  set(block.back, c.back);
  set(block.projection, {x, y, 2 * view.shiftX / target.width}, 2 * view.shiftY / target.height);
  glNamedBufferSubData(camera_.get(), 0, sizeof block, &block);
}

void FrameRenderer::setSky(const ImageRgb& image) {
  sky_.emplace(image, outputScale_);
  stats_.textureBytes += sky_->bytes();
}

void FrameRenderer::prepass(const DrawContext& c, const FrameTarget& target, bool withClear) {
  constexpr GLuint kNobody[4] = {~0u, 0, 0, 0};
  constexpr GLfloat kFar = 0;
  glBindFramebuffer(GL_FRAMEBUFFER, target.prepass.get());
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glClearBufferuiv(GL_COLOR, 0, kNobody);
  glClearBufferfv(GL_DEPTH, 0, &kFar);
  glUseProgram(programs_.prepass().get());
  ranges_.reset();
  for (const Batch& batch : scene_.list.batches) {
    if (batch.variant.masked || (batch.variant.clear && !withClear)) continue;
    for (std::uint32_t r = batch.firstRun; r < batch.endRun(); ++r) {
      if (c.visible[r] != 0) ranges_.add(scene_.list.runs[r].firstVertex, scene_.list.runs[r].vertexCount);
    }
  }
  if (!ranges_.empty()) {
    ranges_.draw();
    state_.countDraw();
  }
  for (const Batch& batch : scene_.list.batches) {
    if (batch.variant.masked) drawBatch(c, PassKind::mask, batch, ranges_, state_);
  }
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
}

void FrameRenderer::bindCommon(const FrameTarget& target) {
  glBindVertexArray(scene_.layout());
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, camera_.get());
  const GLuint buffers[] = {maps_.sides.get(), scene_.materials.get(), maps_.cells.get(), maps_.memberBits.get(),
                            maps_.directions.get()};
  for (GLuint i = 0; i < 5; ++i) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
  const GLuint textures[] = {maps_.directional.get(), maps_.irradiance.get(), maps_.cellTable.get(),
                             scene_.specularTable.get()};
  for (GLuint i = 0; i < 4; ++i) glBindTextureUnit(i, textures[i]);
  glBindTextureUnit(8, target.owner.get());
  glBindTextureUnit(9, maps_.statistics.get());
  glBindTextureUnit(12, maps_.means.get());
}

MapRenderer& FrameRenderer::rendererFor(const View& view, RendererKind renderer) {
  if (view.kind != ViewKind::full) return *views_;
  return renderer == RendererKind::multipass ? *multipass_ : *singlepass_;
}

void FrameRenderer::draw(const FrameView& view, RendererKind renderer, const FrameTarget& target) {
  MapRenderer& shading = rendererFor(view.view, renderer);
  const auto visible =
      visibleRuns(Frustum(view.camera, static_cast<double>(target.width) / target.height), scene_.list.runs);
  drawRuns(view, shading, visible, target);
  stats_.counts = state_.counts();
  stats_.unsorted = shading.unsorted({scene_, maps_, programs_, visible});
  ++stats_.unsorted.draws;
  stats_.charts = visible.size();
  stats_.visibleCharts = static_cast<std::uint64_t>(std::count(visible.begin(), visible.end(), 1));
}

void FrameRenderer::drawSmall(RendererKind renderer, const View& view, const std::vector<std::uint8_t>& visible) {
  FrameView small;
  small.camera.yfov = 1;
  small.view = view;
  constexpr int kSide = 17;  // no power of two, like most windows: llvmpipe compiles for those apart
  const FrameTarget target(kSide, kSide, scaleOf(view.kind) == ViewScale::number);
  drawRuns(small, rendererFor(view, renderer), visible, target);
}

void FrameRenderer::warmUpBeside(RendererKind renderer, const View& view) {
  std::vector<std::uint8_t> visible(scene_.list.runs.size(), 0);
  for (const Batch& batch : scene_.list.batches) visible[batch.firstRun] = 1;
  drawSmall(renderer, view, visible);
  scene_.forgetLayout();
}

void FrameRenderer::warmUp(RendererKind renderer, const View& view, std::size_t step) {
  std::vector<std::uint8_t> visible(scene_.list.runs.size(), 0);
  visible[scene_.list.batches[step].firstRun] = 1;
  drawSmall(renderer, view, visible);
}

void FrameRenderer::drawRuns(const FrameView& view, MapRenderer& shading, const std::vector<std::uint8_t>& visible,
                             const FrameTarget& target) {
  constexpr GLfloat kBlack[4] = {};
  setFixedState(target);
  uploadCamera(view, target);
  bindCommon(target);
  glClearNamedFramebufferfv(target.shading.get(), GL_COLOR, 0, kBlack);
  state_.reset();
  state_.setView(view.view, maps_.wordsPerSide);
  const bool full = view.view.kind == ViewKind::full;
  const DrawContext context{scene_, maps_, programs_, visible};
  prepass(context, target, !full);
  shading.shade(context, target, state_);
  if (full) drawBehindAndBefore(context, view.camera.position, target);
  glDepthMask(GL_TRUE);
}

/// The sky where there is nothing, then what is seen through.
void FrameRenderer::drawBehindAndBefore(const DrawContext& context, Vec3d eye, const FrameTarget& target) {
  if (sky_) {
    sky_->draw(target);
    bindCommon(target);
    state_.forgetBindings();
  }
  drawClear(context, eye, target, state_);
}

}  // namespace lucarne
