// What pilot photons did, by cells of an emission guide, and the guide that follows from it.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/optics/emission_guide.h"

namespace lucarne {

/// Sums by cell, in integers: the same whoever adds first.
class GuideCells {
 public:
  explicit GuideCells(GuideGrid grid);

  /// A photon of the cell cost so much and left light whose squares sum to `square`. From any thread.
  void add(std::size_t cell, std::uint64_t cost, float square);
  /// The same counts on a grid that is coarser by whole factors.
  GuideCells pooled(GuideGrid coarse) const;
  void add(const GuideCells& other);

  struct Sums {
    std::uint64_t photons = 0, cost = 0, squares = 0;
  };
  const GuideGrid& grid() const { return grid_; }
  const std::vector<Sums>& cells() const { return cells_; }
  Sums whole() const;

 private:
  GuideGrid grid_;
  std::vector<Sums> cells_;
};

struct GuideChoice {
  EmissionGuide guide;
  double gain;  // variance times cost of unguided photons over that of guided ones
};

/// The guide that is best of several that differ in how fine they are and how far they trust few photons. Each is
/// learnt from one half of the photons and judged by the other, so that noise is not taken for knowledge; the best is
/// then learnt from all.
///
/// Where a photon of a cell costs c and leaves a mean square m, the density √(m/c) has the least variance at equal
/// cost.
GuideChoice chooseGuide(const GuideCells& learnt, const GuideCells& judged);

}  // namespace lucarne
