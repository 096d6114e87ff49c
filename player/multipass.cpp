#include <algorithm>
#include <vector>

#include "player/map_renderer.h"

namespace lucarne {
namespace {

/// The runs of one batch that have one ψ.
struct PassDraw {
  std::uint32_t batch;
  std::vector<std::uint32_t> runs;
};

/// A second image of sums, for normal maps, beside that of the frame.
struct ReliefTarget {
  int width = 0, height = 0;
  GlTexture sums;
  GlFramebuffer framebuffer;

  void fit(const FrameTarget& target) {
    if (width != target.width || height != target.height) {
      sums = makeTexture({GL_TEXTURE_2D, GL_RGBA32F, 1, target.width, target.height, 1});
      GLuint name = 0;
      glCreateFramebuffers(1, &name);
      framebuffer = GlFramebuffer(name);
      width = target.width;
      height = target.height;
    }
    constexpr GLenum kBoth[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    const GLuint name = framebuffer.get();  // the frame's images may be others at each frame
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, target.lobe.get(), 0);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT1, sums.get(), 0);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, target.depth.get(), 0);
    glNamedFramebufferDrawBuffers(name, 2, kBoth);
    checkComplete(framebuffer, "two 32-bit float images");
  }
};

class Multipass : public MapRenderer {
 public:
  Multipass(const DrawList& list, const LightMaps& maps)
      : passes_(static_cast<std::size_t>(maps.directionCount)), directionsOfRun_(list.runs.size()) {
    for (std::uint32_t b = 0; b < list.batches.size(); ++b) {
      const Batch& batch = list.batches[b];
      if (batch.variant.clear) continue;
      anyRelief_ |= batch.variant.relief && !batch.variant.even;
      for (std::uint32_t r = batch.firstRun; r < batch.endRun(); ++r) addRun(maps, list.runs[r].chart, r, b);
    }
    for (std::size_t psi = 1; psi < passes_.size(); psi += 2) std::reverse(passes_[psi].begin(), passes_[psi].end());
  }

  void shade(const DrawContext& c, const FrameTarget& target, DrawState& state) override {
    if (anyRelief_) relief_.fit(target);
    addDirections(c, target, state);
    glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
    glBindTextureUnit(kLobeUnit, target.lobe.get());
    glBindTextureUnit(kReliefUnit, relief_.sums.get());
    for (const Batch& batch : c.scene.list.batches) {
      if (!batch.variant.clear) drawBatch(c, PassKind::compose, batch, ranges_, state);
    }
  }

  StateCounts unsorted(const DrawContext& c) const override {
    StateCounts counts;
    for (const Batch& batch : c.scene.list.batches) {
      for (std::uint32_t r = batch.firstRun; r < batch.endRun(); ++r) {
        if (c.visible[r] == 0) continue;
        counts.draws += directionsOfRun_[r] + 1;  // and one that composes
        counts.directionSwitches += directionsOfRun_[r];
        counts.materialSwitches += 1;
        counts.textureSwitches += texturesOf(batch.variant);
      }
    }
    return counts;
  }

 private:
  static constexpr GLuint kLobeUnit = 7, kReliefUnit = 11;

  /// Enters a chart into the passes of the directions that either of its sides has.
  void addRun(const LightMaps& maps, std::uint32_t chartIndex, std::uint32_t run, std::uint32_t batch) {
    const MapChart& chart = maps.charts[chartIndex];
    std::vector<std::uint16_t> directions;
    for (const std::uint32_t side : {chart.frontSide, chart.backSide}) {
      if (side == kNone || !maps.sides[side].lit) continue;
      for (const SideDirection& d : maps.sides[side].directions) directions.push_back(d.psi);
    }
    std::sort(directions.begin(), directions.end());
    directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
    for (const std::uint16_t psi : directions) {
      std::vector<PassDraw>& pass = passes_[psi];
      if (pass.empty() || pass.back().batch != batch) pass.push_back({batch, {}});
      pass.back().runs.push_back(run);
    }
    directionsOfRun_[run] = directions.size();
  }

  /// Both sums to nothing, and blending on.
  void beginSums(const FrameTarget& target) const {
    constexpr GLfloat kNothing[4] = {};
    const GLuint sums = anyRelief_ ? relief_.framebuffer.get() : target.sums.get();
    glBindFramebuffer(GL_FRAMEBUFFER, sums);
    glClearNamedFramebufferfv(sums, GL_COLOR, 0, kNothing);
    if (anyRelief_) glClearNamedFramebufferfv(sums, GL_COLOR, 1, kNothing);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
  }

  void addDirections(const DrawContext& c, const FrameTarget& target, DrawState& state) {
    beginSums(target);
    bool writesRelief = true;
    for (std::size_t psi = 0; psi < passes_.size(); ++psi) {
      bool entered = false;
      for (const PassDraw& draw : passes_[psi]) {
        ranges_.reset();
        for (const std::uint32_t r : draw.runs) {
          const ChartRun& run = c.scene.list.runs[r];
          if (c.visible[r] != 0) ranges_.add(run.firstVertex, run.vertexCount);
        }
        if (ranges_.empty()) continue;
        if (!entered) state.setDirection(static_cast<int>(psi), c.maps.wordsPerSide);
        entered = true;
        const Batch& batch = c.scene.list.batches[draw.batch];
        if (anyRelief_ && writesRelief != batch.variant.relief) {  // programs without normal map have no second sum
          writesRelief = batch.variant.relief;
          glColorMaski(1, writesRelief, writesRelief, writesRelief, writesRelief);
        }
        useBatch(c, PassKind::direction, batch, state);
        ranges_.draw();
        state.countDraw();
      }
    }
    if (!writesRelief) glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_BLEND);
  }

  std::vector<std::vector<PassDraw>> passes_;  // [ψ]
  std::vector<std::uint64_t> directionsOfRun_;
  bool anyRelief_ = false;
  ReliefTarget relief_;
  VertexRanges ranges_;
};

}  // namespace

std::unique_ptr<MapRenderer> makeMultipass(const DrawList& list, const LightMaps& maps) {
  return std::make_unique<Multipass>(list, maps);
}

}  // namespace lucarne
