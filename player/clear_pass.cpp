#include <algorithm>

#include "player/map_renderer.h"

namespace lucarne {
namespace {

/// The visible clear triangles, the farthest first.
std::vector<ClearTriangle> farthestFirst(const DrawContext& c, Vec3d eye) {
  std::vector<ClearTriangle> order;
  for (const ClearTriangle& t : c.scene.list.clear) {
    if (c.visible[t.run] != 0) order.push_back(t);
  }
  const auto distance = [&](const ClearTriangle& t) {
    const Vec3d d = Vec3d(t.centre) - eye;
    return dot(d, d);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const ClearTriangle& a, const ClearTriangle& b) { return distance(a) > distance(b); });
  return order;
}

}  // namespace

void drawClear(const DrawContext& c, Vec3d eye, const FrameTarget& target, DrawState& state) {
  const std::vector<ClearTriangle> order = farthestFirst(c, eye);
  if (order.empty()) return;
  glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ONE, GL_ZERO);
  glDepthFunc(GL_GEQUAL);
  VertexRanges ranges;
  for (std::size_t i = 0; i < order.size();) {
    const std::uint32_t batch = order[i].batch;
    ranges.reset();
    for (; i < order.size() && order[i].batch == batch; ++i) ranges.add(order[i].firstVertex, 3);
    useBatch(c, PassKind::clear, c.scene.list.batches[batch], state);
    ranges.draw();
    state.countDraw();
  }
  glDisable(GL_BLEND);
  glDepthFunc(GL_EQUAL);
}

}  // namespace lucarne
