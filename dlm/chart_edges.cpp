#include "dlm/chart_edges.h"

#include <span>
#include <tuple>

namespace lucarne {
namespace {

struct HalfEdge {
  std::uint32_t a, b, material;  // a < b
  std::uint32_t id;              // 3·triangle + corner
  bool forward;                  // runs from a to b
  auto edge() const { return std::tuple(a, b, material); }
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<Corners>& corners, const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> all;
  all.reserve(3 * corners.size());
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    if (corners[t][0] == kNone) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[t][k], to = corners[t][(k + 1) % 3];
      all.push_back({std::min(from, to), std::max(from, to), triangles[t].material, 3 * t + k, from < to});
    }
  }
  std::sort(all.begin(), all.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tuple(x.edge(), x.id) < std::tuple(y.edge(), y.id);
  });
  return all;
}

/// The corner of a triangle off its edge: it tells the sheets at one edge apart.
std::uint32_t apex(const std::vector<Corners>& corners, const HalfEdge& h) {
  return corners[h.id / 3][(h.id + 2 - h.id / 3 * 3) % 3];
}

/// `group`: all half-edges at one edge of one material.
void pairGroup(std::span<const HalfEdge> group, const std::vector<Corners>& corners,
               std::vector<std::uint32_t>& partner) {
  std::vector<const HalfEdge*> first, second;
  const std::uint32_t firstApex = apex(corners, group[0]);
  std::uint32_t secondApex = kNone;
  for (const HalfEdge& h : group) {
    const std::uint32_t own = apex(corners, h);
    if (own == firstApex) {
      first.push_back(&h);
      continue;
    }
    if (secondApex == kNone) secondApex = own;
    if (own != secondApex) return;  // three sheets: nobody's continuation is certain
    second.push_back(&h);
  }
  std::vector<bool> used(second.size(), false);
  for (const HalfEdge* h : first) {
    for (std::size_t i = 0; i < second.size(); ++i) {
      if (used[i] || second[i]->forward == h->forward) continue;
      used[i] = true;
      partner[h->id] = second[i]->id;
      partner[second[i]->id] = h->id;
      break;
    }
  }
}

}  // namespace

std::vector<std::uint32_t> pairHalfEdges(const std::vector<Corners>& corners, const std::vector<Triangle>& triangles) {
  const std::vector<HalfEdge> all = sortedHalfEdges(corners, triangles);
  std::vector<std::uint32_t> partner(3 * corners.size(), kNone);
  for (std::size_t begin = 0, end; begin < all.size(); begin = end) {
    for (end = begin + 1; end < all.size() && all[end].edge() == all[begin].edge();) ++end;
    if (end - begin == 2) {
      const HalfEdge &x = all[begin], &y = all[begin + 1];
      if (x.forward == y.forward || apex(corners, x) == apex(corners, y)) continue;
      partner[x.id] = y.id;
      partner[y.id] = x.id;
    } else if (end - begin > 2) {
      pairGroup({all.data() + begin, end - begin}, corners, partner);
    }
  }
  return partner;
}

}  // namespace lucarne
