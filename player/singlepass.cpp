#include "player/map_renderer.h"

namespace lucarne {
namespace {

class Singlepass : public MapRenderer {
 public:
  explicit Singlepass(const DrawList& list) {
    unsorted_.draws = unsorted_.materialSwitches = list.runs.size();
    for (const Batch& b : list.batches) unsorted_.textureSwitches += b.textured ? 3 * b.runCount : 0;
  }

  void shade(const DrawContext& c, const FrameTarget& target, DrawState& state) override {
    glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
    for (const Batch& batch : c.scene.list.batches) {
      state.useProgram(c.programs.shading(PassKind::singlepass, batch.curved, batch.textured));
      state.useMaterial(batch.material, batch.textured ? &c.scene.textures.of(batch.material) : nullptr);
      glDrawArrays(GL_TRIANGLES, static_cast<GLint>(batch.firstVertex), static_cast<GLsizei>(batch.vertexCount));
      state.countDraw();
    }
  }

  StateCounts unsorted() const override { return unsorted_; }

 private:
  StateCounts unsorted_;
};

}  // namespace

std::unique_ptr<MapRenderer> makeSinglepass(const DrawList& list) { return std::make_unique<Singlepass>(list); }

}  // namespace lucarne
