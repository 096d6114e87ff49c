#include "dlm/contact_groups.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>

namespace lucarne {

/// Hammersley: every strip along an axis holds its share of the places, to one of them. The shift keeps them off lines
/// at round fractions.
Vec2d contactPlace(int i) {
  int reversed = 0;
  for (int bit = 0; bit < 6; ++bit) reversed |= ((i >> bit) & 1) << (5 - bit);
  return {(i + 0.5) / kContactPlaces + 0.0031, (reversed + 0.5) / kContactPlaces - 0.0029};
}

ContactGroups::ContactGroups(const ChartSet& charts, const TexelLayout& layout, std::uint32_t chart,
                             const ContactBins& bins)
    : bins_(bins), layout_(layout.charts[chart]) {
  findSurface(charts, chart);
  std::vector<std::vector<PlaceSet>> all(bins.touched().size());
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t i) { all[i] = groupsOf(static_cast<std::uint32_t>(i)); });
  first_.push_back(0);
  for (const auto& groups : all) {
    groups_.insert(groups_.end(), groups.begin(), groups.end());
    first_.push_back(groups_.size());
  }
}

void ContactGroups::findSurface(const ChartSet& charts, std::uint32_t chart) {
  surface_.assign(bins_.touched().size(), 0);
  for (const std::uint32_t t : charts.charts[chart].triangles) {
    PlanePolygon triangle;
    Vec2d lo{1e300, 1e300}, hi{-1e300, -1e300};
    for (const Vec2f uv : charts.cornerUv[t]) {
      const Vec2d p{static_cast<double>(uv.x) * layout_.texelsPerLocal.x,
                    static_cast<double>(uv.y) * layout_.texelsPerLocal.y};
      triangle.add(p);
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
    triangle = counterClockwise(triangle);
    for (int y = static_cast<int>(lo.y); y <= std::min(layout_.height - 1, static_cast<int>(hi.y)); ++y) {
      for (int x = static_cast<int>(lo.x); x <= std::min(layout_.width - 1, static_cast<int>(hi.x)); ++x) {
        const std::uint32_t touched = bins_.indexOf(
            static_cast<std::size_t>(y) * static_cast<std::size_t>(layout_.width) + static_cast<std::size_t>(x));
        if (touched == kNone) continue;
        for (int i = 0; i < kContactPlaces; ++i)
          if (triangle.holds(Vec2d{double(x), double(y)} + contactPlace(i))) surface_[touched] |= PlaceSet{1} << i;
      }
    }
  }
}

/// Flood from place to place.
std::vector<PlaceSet> ContactGroups::groupsOf(std::uint32_t touched) const {
  const std::uint32_t texel = bins_.touched()[touched];
  const auto width = static_cast<std::uint32_t>(layout_.width);
  const Vec2d corner{static_cast<double>(texel % width), static_cast<double>(texel / width)};
  PlaceSet left = surface_[touched];
  for (int i = 0; i < kContactPlaces; ++i)
    if (((left >> i) & 1) != 0 && bins_.covered(touched, corner + contactPlace(i))) left &= ~(PlaceSet{1} << i);
  std::vector<PlaceSet> groups;
  while (left != 0) {
    PlaceSet group = 0, fresh = left & (~left + 1);
    left &= ~fresh;
    while (fresh != 0) {
      const int i = std::countr_zero(fresh);
      fresh &= fresh - 1;
      group |= PlaceSet{1} << i;
      for (PlaceSet rest = left; rest != 0; rest &= rest - 1) {
        const int j = std::countr_zero(rest);
        if (bins_.crossedIn(touched, corner + contactPlace(i), corner + contactPlace(j))) continue;
        fresh |= PlaceSet{1} << j;
        left &= ~(PlaceSet{1} << j);
      }
    }
    groups.push_back(group);
  }
  return groups;
}

}  // namespace lucarne
