// nearest(): a grid over the octahedral square, each cell with the list of all ψ that can be nearest somewhere in it.
#include <array>

#include "dlm/direction_set.h"

namespace lucarne {

namespace {

// ψ is left out of a grid cell's list when some other ψ' beats it by this much at all of the cell's corners. A cell is
// one or two flat triangles or squares of the octahedron: every unit w in it is Σ λ·corner with λ >= 0 and Σ λ >= 1, so
// (ψ' − ψ)·w, linear in w, is at least the margin everywhere in the cell. The margin is above the rounding of the float
// dot products (below 1e-6 in all, w unit) and of w's place in the grid (below 1e-6, times |ψ' − ψ| <= 2).
constexpr double kMargin = 1e-5;

constexpr int kSmallestGrid = 64, kLargestGrid = 1024, kGridCellsPerDirection = 16;

using Corners = std::array<Vec3d, 4>;

// `size` is even, so that the axes and the fold run along cell edges and diagonals.
Corners cornersOf(int x, int y, int size) {
  const auto at = [&](int i, int j) { return octahedronPoint(2.0 * i / size - 1, 2.0 * j / size - 1); };
  return {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)};
}

using Candidates = std::vector<std::uint16_t>;

class CandidateFinder {
 public:
  explicit CandidateFinder(const std::vector<Vec3d>& directions) : directions_(directions) {}

  /// Those of `candidates` (ascending) that can be nearest within the cell.
  Candidates within(const Corners& corners, const Candidates& candidates) const {
    Candidates kept = notBeatenBy(likeliest(corners, candidates), corners, candidates);
    if (kept.size() > 8) return kept;  // the cell is still large; the lists of its quarters will be cut again
    for (const std::uint16_t rival : Candidates(kept)) kept = notBeatenBy(rival, corners, kept);
    return kept;
  }

 private:
  std::uint16_t likeliest(const Corners& corners, const Candidates& candidates) const {
    const Vec3d middle = corners[0] + corners[1] + corners[2] + corners[3];
    std::uint16_t best = candidates.front();
    for (const std::uint16_t psi : candidates) {
      if (dot(directions_[psi], middle) > dot(directions_[best], middle)) best = psi;
    }
    return best;
  }

  Candidates notBeatenBy(std::uint16_t rival, const Corners& corners, const Candidates& candidates) const {
    Candidates kept;
    for (const std::uint16_t psi : candidates) {
      const Vec3d lead = directions_[psi] - directions_[rival];
      bool beaten = true;
      for (const Vec3d& corner : corners) beaten = beaten && dot(lead, corner) < -kMargin;
      if (!beaten) kept.push_back(psi);
    }
    return kept;
  }

  const std::vector<Vec3d>& directions_;
};

}  // namespace

// Each grid is made from the lists of the grid half as fine: a cell's candidates are among its parent's.
void DirectionSet::buildLookup() {
  const CandidateFinder finder(directions_);
  Candidates all(directions_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint16_t>(i);
  std::vector<Candidates> lists{all};
  gridSize_ = 1;
  const auto fineEnough = [&] {
    const auto cells = static_cast<std::int64_t>(gridSize_) * gridSize_;
    return gridSize_ >= kLargestGrid ||
           (gridSize_ >= kSmallestGrid && cells >= std::int64_t{count()} * kGridCellsPerDirection);
  };
  while (!fineEnough()) {
    const int size = gridSize_ * 2;
    std::vector<Candidates> finer(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const auto parent = static_cast<std::size_t>((y / 2) * gridSize_ + x / 2);
        finer[static_cast<std::size_t>(y * size + x)] = finder.within(cornersOf(x, y, size), lists[parent]);
      }
    }
    lists = std::move(finer);
    gridSize_ = size;
  }
  gridFirst_.push_back(0);
  for (const Candidates& list : lists) {
    gridCandidates_.insert(gridCandidates_.end(), list.begin(), list.end());
    gridFirst_.push_back(static_cast<std::uint32_t>(gridCandidates_.size()));
    if (list.size() <= 2)
      two_.push_back({list.front(), list.back()});
    else
      two_.push_back({kSeveral, kSeveral});
  }
}

int DirectionSet::nearestOfSeveral(std::size_t cell, Vec3f w) const {
  std::uint32_t k = gridFirst_[cell];
  int best = gridCandidates_[k];
  float largest = dot(directionsF_[static_cast<std::size_t>(best)], w);
  for (++k; k < gridFirst_[cell + 1]; ++k) {
    const float d = dot(directionsF_[gridCandidates_[k]], w);
    if (d > largest) {
      largest = d;
      best = gridCandidates_[k];
    }
  }
  return best;
}

}  // namespace lucarne
