#include "app/bake_identity.h"

namespace lucarne {
namespace {

template <class... T>
void addDoubles(Hasher& hasher, T... values) {
  const double all[] = {static_cast<double>(values)...};
  hasher.add(std::as_bytes(std::span(all)));
}

template <class T>
void addVector(Hasher& hasher, const std::vector<T>& values) {
  static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> || sizeof(T) == 24);
  hasher.addNumber(values.size());
  hasher.add(std::as_bytes(std::span(values)));
}

void addChart(Hasher& hasher, const Chart& c, const ChartLayout& l) {
  hasher.addNumber(c.material);
  hasher.addNumber(c.smooth);
  for (const Vec3d& v : {c.normal, c.axisU, c.axisV}) addDoubles(hasher, v.x, v.y, v.z);
  addDoubles(hasher, c.size.x, c.size.y, l.width, l.height, l.texelsPerLocal.x, l.texelsPerLocal.y);
}

void addSide(Hasher& hasher, const TallySide& side, const MemberSet& set) {
  for (const std::uint64_t n : {std::uint64_t{side.chart}, std::uint64_t{side.back}, side.firstLight, side.firstTexel})
    hasher.addNumber(n);
  addVector(hasher, set.members);
}

}  // namespace

Hash128 layoutHash(const BakePlan& plan) {
  Hasher hasher;
  addVector(hasher, plan.charts.chartOfTriangle);
  addVector(hasher, plan.charts.cornerUv);
  for (std::size_t i = 0; i < plan.charts.charts.size(); ++i)
    addChart(hasher, plan.charts.charts[i], plan.layout.charts[i]);
  addVector(hasher, plan.layout.area);
  for (const TallySide& side : plan.tallies.sides) addSide(hasher, side, plan.tallies.membersOf(side));
  for (const Vec3d& d : plan.directions.directions()) addDoubles(hasher, d.x, d.y, d.z);
  return hasher.finish();
}

}  // namespace lucarne
