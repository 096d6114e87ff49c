#include "player/map_renderer.h"

namespace lucarne {
namespace {

/// One draw a batch.
class OnePass : public MapRenderer {
 public:
  OnePass(const DrawList& list, PassKind pass) : pass_(pass) {
    unsorted_.draws = unsorted_.materialSwitches = list.runs.size();
    for (const Batch& b : list.batches) unsorted_.textureSwitches += b.variant.textured ? 3 * b.runCount : 0;
  }

  void shade(const DrawContext& c, const FrameTarget& target, DrawState& state) override {
    glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
    for (const Batch& batch : c.scene.list.batches) {
      state.useProgram(c.programs.shading(pass_, batch.variant));
      state.useMaterial(batch.material, batch.variant.textured ? &c.scene.textures.of(batch.material) : nullptr);
      glDrawArrays(GL_TRIANGLES, static_cast<GLint>(batch.firstVertex), static_cast<GLsizei>(batch.vertexCount));
      state.countDraw();
    }
  }

  StateCounts unsorted() const override { return unsorted_; }

 private:
  PassKind pass_;
  StateCounts unsorted_;
};

}  // namespace

std::unique_ptr<MapRenderer> makeSinglepass(const DrawList& list) {
  return std::make_unique<OnePass>(list, PassKind::singlepass);
}

std::unique_ptr<MapRenderer> makeViewRenderer(const DrawList& list) {
  return std::make_unique<OnePass>(list, PassKind::view);
}

}  // namespace lucarne
