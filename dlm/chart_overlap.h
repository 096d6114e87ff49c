// Triangles in a plane that must not overlap: the test that keeps a chart's projection one-to-one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace lucarne {

using PlaneTriangle = std::array<Vec2d, 3>;  // counter-clockwise

/// Whether the interiors of two triangles meet. Touching is no overlap; neither is meeting less deep than `tolerance`
/// (or than a hundredth of the lesser height, where that is less).
bool overlap(const PlaneTriangle& a, const PlaneTriangle& b, double tolerance);

/// A set of triangles none of which overlap, in a hash grid with one level for each power of two of triangle size, so
/// that a few large triangles among many small ones cost no more than equal ones.
class PlaneTriangleSet {
 public:
  /// `extent`: bound on the coordinates' magnitude.
  PlaneTriangleSet(double extent, double tolerance);

  void clear();
  /// Adds the triangle and returns true, unless it overlaps one of the set. Refuses too, rather than slow down, where a
  /// set's triangles (long parallel slivers) are so many in each other's bounding boxes that the search is no longer
  /// near-linear.
  bool tryAdd(const PlaneTriangle& triangle);
  std::size_t size() const { return entries_.size(); }
  /// Removes what was added last, down to `size` triangles.
  void shrinkTo(std::size_t size);

 private:
  struct Bounds {
    Vec2d lo, hi;
  };
  struct Entry {
    PlaneTriangle triangle;
    Bounds bounds;
    std::uint32_t next;  // in the cell
    std::int32_t x, y, level;
  };
  struct Slot {
    std::int32_t x = 0, y = 0, level = 0;
    std::uint32_t epoch = 0, head = 0;
  };
  struct CellRange {
    std::int64_t x0, y0, x1, y1;  // inclusive
    std::int64_t count() const { return (x1 - x0 + 1) * (y1 - y0 + 1); }
  };

  static Bounds boundsOf(const PlaneTriangle& triangle);
  int levelOf(const Bounds& bounds) const;
  CellRange cellsThatReach(const Bounds& bounds, int level) const;
  bool meets(const Entry& entry, const PlaneTriangle& triangle, const Bounds& bounds);
  bool meetsAny(const PlaneTriangle& triangle, const Bounds& bounds);
  bool meetsAnyOfLevel(int level, const PlaneTriangle& triangle, const Bounds& bounds);
  Slot& slotAt(std::int32_t x, std::int32_t y, std::int32_t level);
  void insert(const PlaneTriangle& triangle, const Bounds& bounds);
  void growTable();
  bool tired() const { return work_ > 256 * (entries_.size() + 4096); }

  double tolerance_, finestCell_;
  std::uint32_t epoch_ = 1;
  std::uint64_t work_ = 0;
  std::size_t usedSlots_ = 0;
  std::vector<Entry> entries_;
  std::vector<std::vector<std::uint32_t>> entriesOfLevel_;
  std::vector<Slot> table_;  // open addressing; a slot of an old epoch is free
};

}  // namespace lucarne
