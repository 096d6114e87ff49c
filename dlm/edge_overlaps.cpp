#include "dlm/edge_overlaps.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace lucarne {
namespace {

constexpr std::uint32_t kMostThrough = 16;  // edges that a point may cut
constexpr double kShortest = 8;             // tolerances: a piece's direction is certain to 1/4
constexpr std::uint32_t kNoPoint = 0xffffffffu;

bool before(Vec3d a, Vec3d b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// The different ends of edges. Those within the tolerance of an earlier one are known by it.
class EdgeEnds {
 public:
  EdgeEnds(std::span<const Segment> edges, double tolerance) : points_(differentEnds(edges)), tree_(points_) {
    known_.assign(points_.size(), kNoPoint);
    std::vector<std::uint32_t> near;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      if (known_[p] != kNoPoint) continue;
      near.clear();
      tree_.findNear({points_[p], points_[p]}, tolerance, near);
      for (const std::uint32_t q : near) {
        if (known_[q] != kNoPoint) continue;
        known_[q] = p;
        if (q != p) tree_.drop(q);
      }
    }
  }

  std::uint32_t indexOf(Vec3d end) const {
    const auto at = std::lower_bound(points_.begin(), points_.end(), end, before);
    return known_[static_cast<std::size_t>(at - points_.begin())];
  }
  Vec3d position(std::uint32_t point) const { return points_[point]; }
  std::size_t size() const { return points_.size(); }
  /// Of those that others are known by.
  PointTree& tree() { return tree_; }

 private:
  static std::vector<Vec3d> differentEnds(std::span<const Segment> edges) {
    std::vector<Vec3d> points;
    points.reserve(2 * edges.size());
    for (const Segment& e : edges) points.insert(points.end(), {e.from, e.to});
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  std::vector<Vec3d> points_;
  PointTree tree_;
  std::vector<std::uint32_t> known_;
};

/// Part of an edge between neighbouring points on it.
struct Piece {
  std::uint32_t lo, hi;  // points, lo < hi
  std::uint32_t edge;
  bool turned;  // the edge runs from hi to lo
};

/// A piece of two edges, along the first.
struct SharedPiece {
  std::uint32_t a, b, from, to;
  double begin;  // fraction of a
};

class OverlapFinder {
 public:
  OverlapFinder(std::span<const Segment> edges, double tolerance)
      : edges_(edges), tolerance_(tolerance), ends_(edges, tolerance) {}

  std::vector<EdgeOverlap> find(std::span<const Segment> others) {
    cutEdges();
    pairPieces();
    dropThirds(others);
    return joined();
  }

 private:
  struct Cut {
    std::uint32_t edge, point;
  };

  void cutEdges() {
    std::vector<Cut> cuts;
    std::vector<std::uint32_t> through(ends_.size(), 0), found;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const std::uint32_t from = ends_.indexOf(edges_[e].from), to = ends_.indexOf(edges_[e].to);
      if (from == to) continue;
      found.clear();
      ends_.tree().findNear({ends_.position(from), ends_.position(to)}, tolerance_, found);
      for (const std::uint32_t p : found) {
        if (p == from || p == to) continue;
        cuts.push_back({e, p});
        if (++through[p] > kMostThrough) ends_.tree().drop(p);
      }
    }
    std::size_t first = 0;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      std::size_t end = first;
      while (end < cuts.size() && cuts[end].edge == e) ++end;
      addPieces(e, {cuts.data() + first, end - first}, through);
      first = end;
    }
  }

  void addPieces(std::uint32_t e, std::span<const Cut> cuts, const std::vector<std::uint32_t>& through) {
    const std::uint32_t last = ends_.indexOf(edges_[e].to);
    std::uint32_t from = ends_.indexOf(edges_[e].from);
    if (from == last) return;
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const Cut& cut : cuts)
      if (through[cut.point] <= kMostThrough)
        order.emplace_back(edges_[e].fractionNear(ends_.position(cut.point)), cut.point);
    std::sort(order.begin(), order.end());
    order.emplace_back(1, last);
    for (const auto& [fraction, to] : order) {
      pieces_.push_back({std::min(from, to), std::max(from, to), e, to < from});
      from = to;
    }
  }

  void pairPieces() {
    std::sort(pieces_.begin(), pieces_.end(), [](const Piece& x, const Piece& y) {
      return std::tie(x.lo, x.hi, x.edge) < std::tie(y.lo, y.hi, y.edge);
    });
    for (std::size_t i = 0, end; i < pieces_.size(); i = end) {
      const Piece& p = pieces_[i];
      for (end = i + 1; end < pieces_.size() && pieces_[end].lo == p.lo && pieces_[end].hi == p.hi;) ++end;
      if (end - i != 2 || length(ends_.position(p.hi) - ends_.position(p.lo)) < kShortest * tolerance_) continue;
      const std::uint32_t from = p.turned ? p.hi : p.lo;
      shared_.push_back({p.edge, pieces_[i + 1].edge, from, p.turned ? p.lo : p.hi,
                         edges_[p.edge].fractionNear(ends_.position(from))});
    }
    std::sort(shared_.begin(), shared_.end(), [](const SharedPiece& x, const SharedPiece& y) {
      return std::tie(x.a, x.b, x.begin) < std::tie(y.a, y.b, y.begin);
    });
  }

  Segment segmentOf(const SharedPiece& p) const { return {ends_.position(p.from), ends_.position(p.to)}; }

  /// Of two that come within the tolerance of each other: whether they have one direction.
  bool runAlong(const Segment& s, const Segment& t) const {
    const Vec3d u = s.to - s.from, v = t.to - t.from;
    const double longer = std::max(length(u), length(v));
    return length(cross(u, v)) <= 2 * tolerance_ * longer && std::min(length(u), length(v)) >= kShortest * tolerance_;
  }

  /// Takes out pieces that a third edge runs along at their middle, or that very many cross there.
  void dropThirds(std::span<const Segment> others) {
    std::vector<Vec3d> middles;
    for (const SharedPiece& p : shared_) middles.push_back(segmentOf(p).at(0.5));
    PointTree tree(middles);
    std::vector<bool> third(shared_.size(), false);
    std::vector<std::uint32_t> through(shared_.size(), 0), found;
    for (const Segment& other : others) {
      found.clear();
      tree.findNear(other, tolerance_, found);
      for (const std::uint32_t p : found) {
        if (++through[p] <= kMostThrough && !runAlong(other, segmentOf(shared_[p]))) continue;
        third[p] = true;
        tree.drop(p);
      }
    }
    std::size_t index = 0;
    std::erase_if(shared_, [&](const SharedPiece&) { return third[index++]; });
  }

  std::vector<EdgeOverlap> joined() const {
    std::vector<EdgeOverlap> all;
    for (std::size_t i = 0, end; i < shared_.size(); i = end) {
      const SharedPiece& p = shared_[i];
      for (end = i + 1; end < shared_.size() && shared_[end].a == p.a && shared_[end].b == p.b &&
                        shared_[end].from == shared_[end - 1].to;)
        ++end;
      const Vec3d from = ends_.position(p.from), to = ends_.position(shared_[end - 1].to);
      const Segment &a = edges_[p.a], &b = edges_[p.b];
      all.push_back({p.a, p.b, a.fractionNear(from), a.fractionNear(to), b.fractionNear(from), b.fractionNear(to)});
    }
    return all;
  }

  std::span<const Segment> edges_;
  double tolerance_;
  EdgeEnds ends_;
  std::vector<Piece> pieces_;
  std::vector<SharedPiece> shared_;
};

}  // namespace

std::vector<EdgeOverlap> findEdgeOverlaps(std::span<const Segment> edges, std::span<const Segment> others,
                                          double tolerance) {
  if (edges.size() < 2) return {};
  return OverlapFinder(edges, tolerance).find(others);
}

}  // namespace lucarne
