#include "tracer/transport/guide_cells.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.h"

namespace lucarne {
namespace {

constexpr float kSquareUnits = 0x1p12f, kLargestSquare = 0x1p24f;

/// Cell of a coarser grid that holds a cell.
std::size_t poolOf(std::size_t cell, const GuideGrid& fine, const GuideGrid& coarse) {
  const auto axis = [&cell](std::uint32_t n, std::uint32_t m) {
    const std::size_t i = cell % n;
    cell /= n;
    return i * m / n;
  };
  const std::size_t py = axis(fine.place, coarse.place), px = axis(fine.place, coarse.place);
  const std::size_t dy = axis(fine.direction, coarse.direction), dx = axis(fine.direction, coarse.direction);
  return ((dx * coarse.direction + dy) * coarse.place + px) * coarse.place + py;
}

/// √(m/c) of each cell, its means drawn toward those of the whole by as much as `pull` photons weigh.
std::vector<double> usefulness(const GuideCells& cells, double pull) {
  const GuideCells::Sums all = cells.whole();
  const auto n = static_cast<double>(all.photons);
  const double square = static_cast<double>(all.squares) / n, cost = static_cast<double>(all.cost) / n;
  std::vector<double> useful;
  for (const GuideCells::Sums& c : cells.cells()) {
    const double m = static_cast<double>(c.squares) + pull * square, c1 = static_cast<double>(c.cost) + pull * cost;
    useful.push_back(std::sqrt(m / c1));
  }
  return useful;
}

/// Variance × cost of the two densities: Σ m/w · Σ w·c over equal cells, w the density.
double gainOf(const EmissionGuide& guide, const GuideCells& judged) {
  double square = 0, cost = 0;
  for (std::size_t c = 0; c < judged.cells().size(); ++c) {
    const double w = guide.densityOf(c);
    square += static_cast<double>(judged.cells()[c].squares) / w;
    cost += static_cast<double>(judged.cells()[c].cost) * w;
  }
  const GuideCells::Sums all = judged.whole();
  return square * cost > 0 ? static_cast<double>(all.squares) * static_cast<double>(all.cost) / (square * cost) : 1;
}

}  // namespace

GuideCells::GuideCells(GuideGrid grid) : grid_(grid), cells_(grid.cells()) {}

void GuideCells::add(std::size_t cell, std::uint64_t cost, float square) {
  const auto plus = [](std::uint64_t& sum, std::uint64_t value) {
    std::atomic_ref<std::uint64_t>(sum).fetch_add(value, std::memory_order_relaxed);
  };
  plus(cells_[cell].photons, 1);
  plus(cells_[cell].cost, cost);
  plus(cells_[cell].squares, static_cast<std::uint64_t>(std::min(square, kLargestSquare) * kSquareUnits));
}

GuideCells GuideCells::pooled(GuideGrid coarse) const {
  GuideCells result(coarse);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Sums& into = result.cells_[poolOf(c, grid_, coarse)];
    into.photons += cells_[c].photons;
    into.cost += cells_[c].cost;
    into.squares += cells_[c].squares;
  }
  return result;
}

void GuideCells::add(const GuideCells& other) {
  LUCARNE_CHECK_EQ(cells_.size(), other.cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c].photons += other.cells_[c].photons;
    cells_[c].cost += other.cells_[c].cost;
    cells_[c].squares += other.cells_[c].squares;
  }
}

GuideCells::Sums GuideCells::whole() const {
  Sums all;
  for (const Sums& c : cells_) {
    all.photons += c.photons;
    all.cost += c.cost;
    all.squares += c.squares;
  }
  return all;
}

GuideChoice chooseGuide(const GuideCells& learnt, const GuideCells& judged) {
  const GuideGrid fine = learnt.grid();
  GuideChoice best{EmissionGuide(fine, std::vector<double>(fine.cells(), 0.0)), 1};
  GuideGrid bestGrid = fine;
  double bestPull = 0;
  for (std::uint32_t direction = 1; direction <= fine.direction; direction *= 2) {
    for (std::uint32_t place = std::min(4u, fine.place); place <= fine.place; place *= 2) {
      const GuideGrid grid{direction, place};
      const GuideCells train = learnt.pooled(grid), test = judged.pooled(grid);
      for (const double pull : {4.0, 32.0}) {
        const EmissionGuide guide(grid, usefulness(train, pull));
        const double gain = gainOf(guide, test);
        if (!(gain > best.gain)) continue;
        best.gain = gain;
        bestGrid = grid;
        bestPull = pull;
      }
    }
  }
  if (bestPull == 0) return best;
  GuideCells all = learnt.pooled(bestGrid);
  all.add(judged.pooled(bestGrid));
  best.guide = EmissionGuide(bestGrid, usefulness(all, bestPull));
  return best;
}

}  // namespace lucarne
