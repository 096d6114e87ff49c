#include "tracer/transport/guide_pilot.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

#include "base/float_mode.h"
#include "tracer/transport/photon_path.h"
#include "tracer/transport/photon_variants.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kPilotSeed = 0x6775696465'70696cu;  // a key that no seed of a bake is mixed with
constexpr double kWorthwhileGain = 1.1;
constexpr std::size_t kMostGuides = 16;
constexpr double kSquareUnit = 0x1p-16;

/// Light that one photon leaves on surfaces, in units of its flux.
struct LightSum {
  float light = 0;
  void hit(const PhotonHit& h) { light += luminance(h.beta); }
  void endPhoton() {}
};

/// Sums by cell of what pilot photons did, in integers.
struct CellSums {
  std::vector<std::uint64_t> photons, rays, squares;
  std::atomic<std::uint64_t> wasted{0};
  explicit CellSums(std::size_t cells) : photons(cells), rays(cells), squares(cells) {}

  void add(std::size_t cell, std::uint64_t rayCount, float light) {
    const auto plus = [](std::uint64_t& sum, std::uint64_t value) {
      std::atomic_ref<std::uint64_t>(sum).fetch_add(value, std::memory_order_relaxed);
    };
    constexpr float kMost = 256;
    const auto square = static_cast<double>(std::min(light, kMost)) * static_cast<double>(std::min(light, kMost));
    plus(photons[cell], 1);
    plus(rays[cell], rayCount);
    plus(squares[cell], static_cast<std::uint64_t>(square / kSquareUnit + 0.5));
    if (!(light > 0)) wasted.fetch_add(1, std::memory_order_relaxed);
  }
};

void tracePilot(const PhotonScene& scene, std::size_t emitter, const EmissionGuide& grid,
                const GuidePilotOptions& options, CellSums& sums) {
  constexpr SceneFeatures kAll = kPhotonVariants[kGeneralVariant].features;
  const TraceLimits limits;
  const PhotonSeed seed(options.seed ^ kPilotSeed, SamplerKind::sobol);
  const std::uint64_t first = std::uint64_t{emitter} * options.photons;
  tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, options.photons, 1024), [&](const auto& range) {
    const FlushDenormals mode;
    for (std::uint64_t i = range.begin(); i < range.end(); ++i) {
      const PhotonSampler sampler(seed, first + i);
      const EmissionNumbers numbers = sampler.emission();
      const EmissionPlace u = scene.emitters().placeFor(emitter, numbers.pick, numbers.others);
      LightSum sink;
      Ledger ledger;
      PhotonPath<kAll, LightSum> path(scene, sampler, limits, sink, ledger);
      path.trace(scene.emitters().sampleUnguided(emitter, u));
      sums.add(grid.cellOf(u.direction, u.position), ledger.rays, sink.light);
    }
  });
}

/// Mean by cell of (square, rays), drawn toward the mean of 2 × 2 × 4 × 4 cells around by as much as a few photons
/// weigh: most cells see only a few dozen.
class SmoothedCells {
 public:
  SmoothedCells(const GuideGrid& grid, const CellSums& sums) : grid_(grid), sums_(sums) {
    coarse_ = {std::max(grid.direction / 2, 1u), std::max(grid.place / 4, 1u)};
    parents_.resize(coarse_.cells());
    for (std::size_t c = 0; c < sums.photons.size(); ++c) add(parents_[parentOf(c)], c);
    for (std::size_t c = 0; c < sums.photons.size(); ++c) add(whole_, c);
  }
  struct Mean {
    double square, cost;
  };
  Mean at(std::size_t cell) const {
    constexpr double kPull = 4;
    const Mean parent = blend(parents_[parentOf(cell)], meanOf(whole_), 1);
    Sums own{};
    add(own, cell);
    return blend(own, parent, kPull);
  }

 private:
  struct Sums {
    double photons = 0, rays = 0, squares = 0;
  };
  static Mean meanOf(const Sums& s) { return {s.squares / s.photons, s.rays / s.photons}; }
  static Mean blend(const Sums& s, Mean prior, double pull) {
    return {(s.squares + pull * prior.square) / (s.photons + pull), (s.rays + pull * prior.cost) / (s.photons + pull)};
  }
  void add(Sums& into, std::size_t cell) const {
    into.photons += static_cast<double>(sums_.photons[cell]);
    into.rays += static_cast<double>(sums_.rays[cell]);
    into.squares += static_cast<double>(sums_.squares[cell]) * kSquareUnit;
  }
  std::size_t parentOf(std::size_t cell) const {
    const auto axis = [&cell](std::uint32_t n, std::uint32_t coarse) {
      const std::size_t i = cell % n;
      cell /= n;
      return i * coarse / n;
    };
    const std::size_t py = axis(grid_.place, coarse_.place), px = axis(grid_.place, coarse_.place);
    const std::size_t dy = axis(grid_.direction, coarse_.direction), dx = axis(grid_.direction, coarse_.direction);
    return ((dx * coarse_.direction + dy) * coarse_.place + px) * coarse_.place + py;
  }

  GuideGrid grid_, coarse_;
  const CellSums& sums_;
  std::vector<Sums> parents_;
  Sums whole_;
};

/// Variance × cost of the two densities: Σ m/w · Σ w·c over equal cells, w the density.
double gainOf(const SmoothedCells& cells, const EmissionGuide& guide) {
  double plainSquare = 0, plainCost = 0, square = 0, cost = 0;
  for (std::size_t c = 0; c < guide.grid().cells(); ++c) {
    const SmoothedCells::Mean m = cells.at(c);
    const double w = guide.densityOf(c);
    plainSquare += m.square;
    plainCost += m.cost;
    square += m.square / w;
    cost += m.cost * w;
  }
  return square * cost > 0 ? plainSquare * plainCost / (square * cost) : 1;
}

}  // namespace

std::vector<GuidePilotResult> learnGuides(PhotonScene& scene, const GuidePilotOptions& options) {
  std::vector<GuidePilotResult> results;
  for (std::size_t e = 0; e < scene.emitters().size() && results.size() < kMostGuides; ++e) {
    if (!scene.emitters().isDistant(e)) continue;
    const bool isSky = scene.emitters().hasSky() && e + 1 == scene.emitters().size();
    const GuideGrid grid = isSky ? GuideGrid{8, 16} : GuideGrid{1, 64};
    const EmissionGuide uniform(grid, std::vector<double>(grid.cells(), 0.0));
    CellSums sums(grid.cells());
    tracePilot(scene, e, uniform, options, sums);
    const SmoothedCells cells(grid, sums);
    std::vector<double> usefulness(grid.cells());
    for (std::size_t c = 0; c < usefulness.size(); ++c) {
      const SmoothedCells::Mean m = cells.at(c);
      usefulness[c] = std::sqrt(m.square / m.cost);
    }
    EmissionGuide guide(grid, usefulness);
    const double gain = gainOf(cells, guide);
    results.push_back({e, static_cast<double>(sums.wasted.load()) / static_cast<double>(options.photons), gain,
                       gain > kWorthwhileGain});
    if (results.back().guided) scene.setGuide(e, std::move(guide));
  }
  return results;
}

}  // namespace lucarne
