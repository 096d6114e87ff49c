#include "dlm/point_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lucarne {
namespace {

constexpr std::uint32_t kLeaf = 8;
constexpr std::uint32_t kNoNode = 0xffffffffu;

/// Whether the segment comes within `margin` of the box, along each axis.
bool meets(const Segment& s, const Box& box, double margin) {
  double begin = 0, end = 1;
  for (int i = 0; i < 3; ++i) {
    const double lo = box.lo[i] - margin, hi = box.hi[i] + margin, from = s.from[i], run = s.to[i] - from;
    if (std::abs(run) <= 1e-3 * margin) {
      if (std::max(from, s.to[i]) < lo || std::min(from, s.to[i]) > hi) return false;
      continue;
    }
    const double a = (lo - from) / run, b = (hi - from) / run;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    if (begin > end) return false;
  }
  return true;
}

int widestAxis(const Box& box) {
  const Vec3d e = box.extent();
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

}  // namespace

double Segment::fractionNear(Vec3d p) const {
  const Vec3d run = to - from;
  const double square = dot(run, run);
  return square > 0 ? std::clamp(dot(p - from, run) / square, 0.0, 1.0) : 0;
}

PointTree::PointTree(std::span<const Vec3d> points)
    : points_(points), order_(points.size()), leafOf_(points.size()), dropped_(points.size(), false) {
  std::iota(order_.begin(), order_.end(), 0u);
  const auto count = static_cast<std::uint32_t>(points.size());
  nodes_.push_back({{}, 0, count, kNoNode, kNoNode, count});
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) split(n);
}

/// Fills in the node's box and gives it children, each with half of its points.
void PointTree::split(std::uint32_t n) {
  Node node = nodes_[n];
  for (std::uint32_t i = node.begin; i < node.end; ++i) node.box.add(points_[order_[i]]);
  if (node.end - node.begin > kLeaf) {
    const int axis = widestAxis(node.box);
    const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
    std::nth_element(order_.begin() + node.begin, order_.begin() + middle, order_.begin() + node.end,
                     [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    node.child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, node.begin, middle, kNoNode, n, middle - node.begin});
    nodes_.push_back({{}, middle, node.end, kNoNode, n, node.end - middle});
  } else {
    for (std::uint32_t i = node.begin; i < node.end; ++i) leafOf_[order_[i]] = n;
  }
  nodes_[n] = node;
}

void PointTree::findNear(const Segment& segment, double tolerance, std::vector<std::uint32_t>& found) const {
  std::array<std::uint32_t, 64> stack;  // deeper than 2^32 points halved can be
  std::size_t height = 0;
  stack[height++] = 0;
  while (height > 0) {
    const Node& node = nodes_[stack[--height]];
    if (node.live == 0 || !meets(segment, node.box, tolerance)) continue;
    if (node.child != kNoNode) {
      stack[height++] = node.child + 1;
      stack[height++] = node.child;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t p = order_[i];
      if (dropped_[p]) continue;
      const Vec3d off = points_[p] - segment.at(segment.fractionNear(points_[p]));
      if (dot(off, off) <= tolerance * tolerance) found.push_back(p);
    }
  }
}

void PointTree::drop(std::uint32_t point) {
  dropped_[point] = true;
  for (std::uint32_t n = leafOf_[point]; n != kNoNode; n = nodes_[n].parent) --nodes_[n].live;
}

}  // namespace lucarne
