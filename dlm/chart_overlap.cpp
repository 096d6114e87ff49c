#include "dlm/chart_overlap.h"

#include "dlm/plane_polygon.h"

namespace lucarne {
namespace {

constexpr std::uint32_t kEnd = 0xffffffffu;
constexpr int kLevels = 30;  // the finest cells are 2^-28 of the extent: their indices fit in 32 bits

double smallestHeight(const PlaneTriangle& t) {
  double longest2 = 0;
  for (int k = 0; k < 3; ++k) longest2 = std::max(longest2, dot(t[(k + 1) % 3] - t[k], t[(k + 1) % 3] - t[k]));
  return longest2 > 0 ? std::abs(orient(t[0], t[1], t[2])) / std::sqrt(longest2) : 0;
}

/// Whether an edge of `a` has all of `b` beyond it, up to `depth`.
bool separates(const PlaneTriangle& a, const PlaneTriangle& b, double depth) {
  for (int k = 0; k < 3; ++k) {
    const Vec2d p = a[k], q = a[(k + 1) % 3];
    const double inside = std::max({orient(p, q, b[0]), orient(p, q, b[1]), orient(p, q, b[2])});
    if (inside <= 0 || inside * inside <= depth * depth * dot(q - p, q - p)) return true;
  }
  return false;
}

std::size_t hashCell(std::int32_t x, std::int32_t y, std::int32_t level) {
  std::uint64_t h = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
  h = (h ^ static_cast<std::uint64_t>(level)) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 32)) * 0xbf58476d1ce4e5b9u;
  return h ^ (h >> 29);
}

}  // namespace

bool overlap(const PlaneTriangle& a, const PlaneTriangle& b, double tolerance) {
  if (separates(a, b, 0) || separates(b, a, 0)) return false;
  const double depth = std::min(tolerance, 0.01 * std::min(smallestHeight(a), smallestHeight(b)));
  return !separates(a, b, depth) && !separates(b, a, depth);
}

PlaneTriangleSet::PlaneTriangleSet(double extent, double tolerance)
    : tolerance_(tolerance), finestCell_(1), entriesOfLevel_(kLevels + 2), table_(1024) {
  int exponent = 0;
  std::frexp(extent, &exponent);
  finestCell_ = std::ldexp(1.0, exponent - 28);
}

void PlaneTriangleSet::clear() {
  ++epoch_;
  work_ = 0;
  usedSlots_ = 0;
  entries_.clear();
  for (auto& level : entriesOfLevel_) level.clear();
}

bool PlaneTriangleSet::tryAdd(const PlaneTriangle& triangle) {
  const Bounds bounds = boundsOf(triangle);
  if (meetsAny(triangle, bounds)) return false;
  insert(triangle, bounds);
  return true;
}

PlaneTriangleSet::Bounds PlaneTriangleSet::boundsOf(const PlaneTriangle& t) {
  return {{std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y})},
          {std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y})}};
}

/// The finest level whose cells are no smaller than the triangle, so that it lies in a cell and its upper neighbours.
int PlaneTriangleSet::levelOf(const Bounds& b) const {
  int exponent = 0;
  std::frexp(std::max(b.hi.x - b.lo.x, b.hi.y - b.lo.y) / finestCell_, &exponent);
  return std::clamp(exponent, 0, kLevels + 1);
}

PlaneTriangleSet::CellRange PlaneTriangleSet::cellsThatReach(const Bounds& b, int level) const {
  const double cell = std::ldexp(finestCell_, level);
  const auto index = [cell](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  return {index(b.lo.x) - 1, index(b.lo.y) - 1, index(b.hi.x), index(b.hi.y)};
}

bool PlaneTriangleSet::meets(const Entry& entry, const PlaneTriangle& triangle, const Bounds& b) {
  ++work_;
  if (entry.bounds.lo.x >= b.hi.x || entry.bounds.hi.x <= b.lo.x) return false;
  if (entry.bounds.lo.y >= b.hi.y || entry.bounds.hi.y <= b.lo.y) return false;
  return overlap(entry.triangle, triangle, tolerance_);
}

bool PlaneTriangleSet::meetsAny(const PlaneTriangle& triangle, const Bounds& bounds) {
  for (int level = 0; level < static_cast<int>(entriesOfLevel_.size()); ++level) {
    if (!entriesOfLevel_[static_cast<std::size_t>(level)].empty() && meetsAnyOfLevel(level, triangle, bounds)) {
      return true;
    }
  }
  return false;
}

bool PlaneTriangleSet::meetsAnyOfLevel(int level, const PlaneTriangle& triangle, const Bounds& bounds) {
  const auto& entries = entriesOfLevel_[static_cast<std::size_t>(level)];
  const CellRange cells = cellsThatReach(bounds, level);
  if (cells.count() > static_cast<std::int64_t>(entries.size())) {
    for (const std::uint32_t i : entries) {
      if (tired() || meets(entries_[i], triangle, bounds)) return true;
    }
    return false;
  }
  for (std::int64_t y = cells.y0; y <= cells.y1; ++y) {
    for (std::int64_t x = cells.x0; x <= cells.x1; ++x) {
      ++work_;
      const Slot& slot = slotAt(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), level);
      if (slot.epoch != epoch_) continue;
      for (std::uint32_t i = slot.head; i != kEnd; i = entries_[i].next) {
        if (tired() || meets(entries_[i], triangle, bounds)) return true;
      }
    }
  }
  return false;
}

PlaneTriangleSet::Slot& PlaneTriangleSet::slotAt(std::int32_t x, std::int32_t y, std::int32_t level) {
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = hashCell(x, y, level) & mask;; i = (i + 1) & mask) {
    Slot& s = table_[i];
    if (s.epoch != epoch_ || (s.x == x && s.y == y && s.level == level)) return s;
  }
}

void PlaneTriangleSet::insert(const PlaneTriangle& triangle, const Bounds& bounds) {
  if (2 * usedSlots_ >= table_.size()) growTable();
  const int level = levelOf(bounds);
  const CellRange cells = cellsThatReach(bounds, level);
  const auto x = static_cast<std::int32_t>(cells.x0 + 1), y = static_cast<std::int32_t>(cells.y0 + 1);
  Slot& slot = slotAt(x, y, level);
  if (slot.epoch != epoch_) {
    slot = {x, y, level, epoch_, kEnd};
    ++usedSlots_;
  }
  const auto index = static_cast<std::uint32_t>(entries_.size());
  entries_.push_back({triangle, bounds, slot.head, x, y, level});
  slot.head = index;
  entriesOfLevel_[static_cast<std::size_t>(level)].push_back(index);
}

void PlaneTriangleSet::shrinkTo(std::size_t size) {
  while (entries_.size() > size) {
    const Entry& last = entries_.back();
    slotAt(last.x, last.y, last.level).head = last.next;
    entriesOfLevel_[static_cast<std::size_t>(last.level)].pop_back();
    entries_.pop_back();
  }
}

void PlaneTriangleSet::growTable() {
  std::vector<Slot> old(2 * table_.size());
  old.swap(table_);
  for (const Slot& s : old) {
    if (s.epoch == epoch_) slotAt(s.x, s.y, s.level) = s;
  }
}

}  // namespace lucarne
