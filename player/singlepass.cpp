#include "player/map_renderer.h"

namespace lucarne {
namespace {

/// One draw a batch.
class OnePass : public MapRenderer {
 public:
  explicit OnePass(PassKind pass) : pass_(pass) {}

  void shade(const DrawContext& c, const FrameTarget& target, DrawState& state) override {
    glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
    for (const Batch& batch : c.scene.list.batches) {
      if (!batch.variant.clear || pass_ == PassKind::view) drawBatch(c, pass_, batch, ranges_, state);
    }
  }

  StateCounts unsorted(const DrawContext& c) const override {
    StateCounts counts;
    for (const Batch& batch : c.scene.list.batches) {
      for (std::uint32_t r = batch.firstRun; r < batch.endRun(); ++r) {
        if (c.visible[r] == 0) continue;
        ++counts.draws;
        ++counts.materialSwitches;
        counts.textureSwitches += texturesOf(batch.variant);
      }
    }
    return counts;
  }

 private:
  PassKind pass_;
  VertexRanges ranges_;
};

}  // namespace

void useBatch(const DrawContext& c, PassKind pass, const Batch& batch, DrawState& state) {
  state.useProgram(c.programs.shading(pass, batch.variant));
  state.useMaterial(batch.material, texturesOf(batch.variant) > 0 ? &c.scene.textures.of(batch.material) : nullptr);
}

void drawBatch(const DrawContext& c, PassKind pass, const Batch& batch, VertexRanges& scratch, DrawState& state) {
  scratch.reset();
  for (std::uint32_t r = batch.firstRun; r < batch.endRun(); ++r) {
    const ChartRun& run = c.scene.list.runs[r];
    if (c.visible[r] != 0) scratch.add(run.firstVertex, run.vertexCount);
  }
  if (scratch.empty()) return;
  useBatch(c, pass, batch, state);
  scratch.draw();
  state.countDraw();
}

std::unique_ptr<MapRenderer> makeSinglepass() { return std::make_unique<OnePass>(PassKind::singlepass); }

std::unique_ptr<MapRenderer> makeViewRenderer() { return std::make_unique<OnePass>(PassKind::view); }

}  // namespace lucarne
