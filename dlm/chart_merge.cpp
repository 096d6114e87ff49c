#include "dlm/chart_merge.h"

#include <numeric>

namespace lucarne {
namespace {

constexpr std::size_t kSmall = 64;        // triangles of a chart that may join another
constexpr std::size_t kMostOfPair = 512;  // triangles of two that join each other: bounds the work

class Merger {
 public:
  Merger(const ChartFaces& faces, std::vector<GrownChart>& charts, double cosMaxAngle, PlaneTriangleSet& overlaps)
      : faces_(faces),
        charts_(charts),
        cosMaxAngle_(cosMaxAngle),
        overlaps_(overlaps),
        chartOf_(faces.area.size(), kNone) {
    for (std::uint32_t c = 0; c < charts_.size(); ++c) {
      for (const std::uint32_t t : charts_[c].triangles) chartOf_[t] = c;
    }
  }

  void run() {
    for (int pass = 0; pass < 4 && joinPairs(); ++pass) continue;
    std::vector<std::uint32_t> order = bySize();
    std::reverse(order.begin(), order.end());
    for (const std::uint32_t c : order) absorbNeighbours(c);
    std::erase_if(charts_, [](const GrownChart& chart) { return chart.triangles.empty(); });
  }

 private:
  std::size_t sizeOf(std::uint32_t chart) const { return charts_[chart].triangles.size(); }

  std::vector<std::uint32_t> bySize() const {
    std::vector<std::uint32_t> order(charts_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [this](auto a, auto b) { return sizeOf(a) < sizeOf(b); });
    return order;
  }

  /// Other charts across the edges of a chart's triangles from index `first` on, each once, in order.
  std::vector<std::uint32_t> neighbours(std::uint32_t chart, std::size_t first = 0) const {
    std::vector<std::uint32_t> found;
    const auto& triangles = charts_[chart].triangles;
    for (std::size_t i = first; i < triangles.size(); ++i) {
      for (const EdgeLink& link : faces_.mesh.links[triangles[i]]) {
        if (link.triangle != kNone && chartOf_[link.triangle] != chart) found.push_back(chartOf_[link.triangle]);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void moveInto(std::uint32_t to, std::uint32_t from) {
    for (const std::uint32_t t : charts_[from].triangles) {
      chartOf_[t] = to;
      charts_[to].triangles.push_back(t);
    }
    charts_[from].triangles.clear();
  }

  /// Adds the triangles, or none of them.
  bool addAll(const std::vector<std::uint32_t>& triangles, const ProjectionPlane& plane) {
    const std::size_t before = overlaps_.size();
    for (const std::uint32_t t : triangles) {
      if (overlaps_.tryAdd(faces_.project(t, plane))) continue;
      overlaps_.shrinkTo(before);
      return false;
    }
    return true;
  }

  bool joinPair(std::uint32_t a, std::uint32_t b) {
    std::vector<std::uint32_t> both = charts_[a].triangles;
    both.insert(both.end(), charts_[b].triangles.begin(), charts_[b].triangles.end());
    const Vec3d mean = faces_.meanNormal(both);
    if (faces_.smallestCosine(both, mean) < cosMaxAngle_) return false;
    overlaps_.clear();
    if (!addAll(both, ProjectionPlane(mean, faces_.mesh.corner(both[0], 0)))) return false;
    moveInto(a, b);
    charts_[a].normal = mean;
    return true;
  }

  bool joinPairs() {
    bool any = false;
    for (const std::uint32_t c : bySize()) {
      if (sizeOf(c) == 0 || sizeOf(c) > kSmall) continue;
      for (const std::uint32_t other : neighbours(c)) {
        if (sizeOf(c) + sizeOf(other) > kMostOfPair || !joinPair(other, c)) continue;
        any = true;
        break;
      }
    }
    return any;
  }

  bool mayTakeIn(std::uint32_t chart, std::uint32_t other) const {
    return sizeOf(other) <= std::min(kSmall, sizeOf(chart)) &&
           faces_.smallestCosine(charts_[other].triangles, charts_[chart].normal) >= cosMaxAngle_;
  }

  void absorbNeighbours(std::uint32_t chart) {
    bool laidOut = false;
    for (std::size_t seen = 0; seen < sizeOf(chart);) {
      const std::vector<std::uint32_t> around = neighbours(chart, seen);
      seen = sizeOf(chart);
      for (const std::uint32_t other : around) {
        if (!mayTakeIn(chart, other)) continue;
        const ProjectionPlane plane(charts_[chart].normal, faces_.mesh.corner(charts_[chart].triangles[0], 0));
        if (!laidOut) {
          overlaps_.clear();
          if (!addAll(charts_[chart].triangles, plane)) return;
          laidOut = true;
        }
        if (addAll(charts_[other].triangles, plane)) moveInto(chart, other);
      }
    }
  }

  const ChartFaces& faces_;
  std::vector<GrownChart>& charts_;
  double cosMaxAngle_;
  PlaneTriangleSet& overlaps_;
  std::vector<std::uint32_t> chartOf_;
};

}  // namespace

std::vector<GrownChart> mergeCharts(const ChartFaces& faces, std::vector<GrownChart> charts, double cosMaxAngle,
                                    PlaneTriangleSet& overlaps) {
  Merger(faces, charts, cosMaxAngle, overlaps).run();
  return charts;
}

}  // namespace lucarne
