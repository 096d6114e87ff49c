#include "dlm/deposit.h"

namespace lucarne {

TexelMap::TexelMap(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const TallyLayout& tallies) {
  for (const TallySide& s : tallies.sides) {
    const MemberSet& set = tallies.membersOf(s);
    sides_.push_back({s.width, s.height, s.firstLight, s.firstTexel, s.texelCount(), s.firstMoment,
                      set.members.empty() ? nullptr : set.rank.data()});
    members_.push_back(set.members.data());
  }
  entries_.resize(scene.triangles.size(), Entry{{}, {}, {}, kNone, kNone});
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const std::uint32_t c = charts.chartOfTriangle[t];
    if (c == kNone) continue;
    const Vec2d scale = layout.charts[c].texelsPerLocal;
    std::array<Vec2d, 3> st;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = charts.cornerUv[t][k];
      st[k] = {static_cast<double>(uv.x) * scale.x, static_cast<double>(uv.y) * scale.y};
    }
    const auto toFloat = [](Vec2d v) { return Vec2f{static_cast<float>(v.x), static_cast<float>(v.y)}; };
    entries_[t] = {toFloat(st[0]), toFloat(st[1] - st[0]), toFloat(st[2] - st[0]), tallies.frontSide[c],
                   tallies.backSide[c]};
  }
}

}  // namespace lucarne
