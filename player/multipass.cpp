#include <algorithm>
#include <vector>

#include "player/map_renderer.h"

namespace lucarne {
namespace {

/// The vertex ranges of one batch that have one ψ.
struct PassDraw {
  std::uint32_t batch;
  std::vector<GLint> first;
  std::vector<GLsizei> count;
};

class Multipass : public MapRenderer {
 public:
  Multipass(const DrawList& list, const LightMaps& maps) : passes_(static_cast<std::size_t>(maps.directionCount)) {
    for (std::uint32_t b = 0; b < list.batches.size(); ++b) {
      const Batch& batch = list.batches[b];
      for (std::uint32_t r = batch.firstRun; r < batch.firstRun + batch.runCount; ++r)
        addRun(maps, list.runs[r], b, batch.variant.textured);
    }
    for (std::size_t psi = 1; psi < passes_.size(); psi += 2) std::reverse(passes_[psi].begin(), passes_[psi].end());
  }

  void shade(const DrawContext& c, const FrameTarget& target, DrawState& state) override {
    addDirections(c, target, state);
    glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
    glBindTextureUnit(kLobeUnit, target.lobe.get());
    for (const Batch& batch : c.scene.list.batches) {
      prepare(c, PassKind::compose, batch, state);
      glDrawArrays(GL_TRIANGLES, static_cast<GLint>(batch.firstVertex), static_cast<GLsizei>(batch.vertexCount));
      state.countDraw();
    }
  }

  StateCounts unsorted() const override { return unsorted_; }

 private:
  static constexpr GLuint kLobeUnit = 7;

  /// Enters a chart into the passes of the directions that either of its sides has, next to the range before it if it
  /// can.
  void addRun(const LightMaps& maps, const ChartRun& run, std::uint32_t batch, bool textured) {
    const MapChart& chart = maps.charts[run.chart];
    std::vector<std::uint16_t> directions;
    for (const std::uint32_t side : {chart.frontSide, chart.backSide}) {
      if (side == kNone || !maps.sides[side].lit) continue;
      for (const SideDirection& d : maps.sides[side].directions) directions.push_back(d.psi);
    }
    std::sort(directions.begin(), directions.end());
    directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
    for (const std::uint16_t psi : directions) {
      std::vector<PassDraw>& pass = passes_[psi];
      if (pass.empty() || pass.back().batch != batch) pass.push_back({batch, {}, {}});
      PassDraw& draw = pass.back();
      const auto first = static_cast<GLint>(run.firstVertex), count = static_cast<GLint>(run.vertexCount);
      if (!draw.first.empty() && draw.first.back() + draw.count.back() == first) {
        draw.count.back() += count;
      } else {
        draw.first.push_back(first);
        draw.count.push_back(count);
      }
    }
    unsorted_.draws += directions.size() + 1;  // and one that composes
    unsorted_.directionSwitches += directions.size();
    unsorted_.materialSwitches += 1;
    unsorted_.textureSwitches += textured ? 3 : 0;
  }

  void prepare(const DrawContext& c, PassKind pass, const Batch& batch, DrawState& state) const {
    state.useProgram(c.programs.shading(pass, batch.variant));
    state.useMaterial(batch.material, batch.variant.textured ? &c.scene.textures.of(batch.material) : nullptr);
  }

  void addDirections(const DrawContext& c, const FrameTarget& target, DrawState& state) const {
    constexpr GLfloat kNothing[4] = {};
    glClearNamedFramebufferfv(target.sums.get(), GL_COLOR, 0, kNothing);
    glBindFramebuffer(GL_FRAMEBUFFER, target.sums.get());
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    for (std::size_t psi = 0; psi < passes_.size(); ++psi) {
      if (passes_[psi].empty()) continue;
      state.setDirection(static_cast<int>(psi), c.maps.wordsPerSide);
      for (const PassDraw& draw : passes_[psi]) {
        prepare(c, PassKind::direction, c.scene.list.batches[draw.batch], state);
        glMultiDrawArrays(GL_TRIANGLES, draw.first.data(), draw.count.data(), static_cast<GLsizei>(draw.first.size()));
        state.countDraw();
      }
    }
    glDisable(GL_BLEND);
  }

  std::vector<std::vector<PassDraw>> passes_;  // [ψ]
  StateCounts unsorted_;
};

}  // namespace

std::unique_ptr<MapRenderer> makeMultipass(const DrawList& list, const LightMaps& maps) {
  return std::make_unique<Multipass>(list, maps);
}

}  // namespace lucarne
