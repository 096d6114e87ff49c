// Points in space, and which of them lie on a segment: a k-d tree with a box a node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lucarne {

struct Segment {
  Vec3d from, to;
  Vec3d at(double fraction) const { return from * (1 - fraction) + to * fraction; }
  /// Of the place nearest to `p`; 0 on a segment without length.
  double fractionNear(Vec3d p) const;
};

/// Points are known by their index. Asking takes time in proportion to what lies near the segment, plus the depth.
class PointTree {
 public:
  /// All coordinates finite.
  explicit PointTree(std::span<const Vec3d> points);

  /// Appends the points within `tolerance` of the segment, in an order of no meaning.
  void findNear(const Segment& segment, double tolerance, std::vector<std::uint32_t>& found) const;
  /// Takes a point out, once: it will not be found any more, nor cost time.
  void drop(std::uint32_t point);

 private:
  struct Node {
    Box box;
    std::uint32_t begin, end;     // into order_
    std::uint32_t child, parent;  // two children in a row; none: a leaf
    std::uint32_t live;           // points not dropped
  };
  void split(std::uint32_t node);

  std::span<const Vec3d> points_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_, leafOf_;
  std::vector<bool> dropped_;
};

}  // namespace lucarne
