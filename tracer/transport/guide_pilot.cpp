#include "tracer/transport/guide_pilot.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <functional>

#include "base/float_mode.h"
#include "tracer/transport/guide_cells.h"
#include "tracer/transport/photon_path.h"
#include "tracer/transport/photon_variants.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kPilotSeed = 0x6775696465'70696cu;  // a key that no seed of a bake is mixed with
constexpr double kWorthwhileGain = 1.5;
constexpr std::size_t kMostGuides = 16;

void addTo(std::uint64_t& sum, std::uint64_t value) {
  std::atomic_ref<std::uint64_t>(sum).fetch_add(value, std::memory_order_relaxed);
}

/// Light that falls on each triangle, in integers.
class TriangleLight {
 public:
  explicit TriangleLight(const PhotonScene& scene) : units_(scene.scene().triangles.size()) {
    for (std::uint32_t t = 0; t < units_.size(); ++t) {
      areas_.push_back(0.5 * length(scene.scene().scaledNormal(t)));
      area_ += areas_.back();
    }
  }
  void add(std::uint32_t triangle, float light) { addTo(units_[triangle], static_cast<std::uint64_t>(light * kUnit)); }

  /// By triangle the inverse square of its irradiance over the mean: an error counts by how large it is to what is
  /// there. Triangles that met few photons are drawn toward the mean.
  std::vector<float> weights() const {
    double all = 0;
    for (const std::uint64_t u : units_) all += static_cast<double>(u) / kUnit;
    constexpr double kPull = 3, kDimmest = 0.01, kBrightest = 100;
    std::vector<float> weights;
    for (std::size_t t = 0; t < units_.size(); ++t) {
      const double expected = area_ > 0 ? all * areas_[t] / area_ : 0;
      const double ratio = (static_cast<double>(units_[t]) / kUnit + kPull) / (expected + kPull);
      const double clamped = std::clamp(ratio, kDimmest, kBrightest);
      weights.push_back(static_cast<float>(1 / clamped));
    }
    return weights;
  }

 private:
  static constexpr float kUnit = 0x1p16f;
  std::vector<std::uint64_t> units_;
  std::vector<double> areas_;
  double area_ = 0;
};

struct PilotSink {
  TriangleLight* light;               // null: not asked for
  const std::vector<float>* weights;  // by triangle; null: not known yet
  float square = 0;                   // Σ weight · beta² over the hits
  bool used = false;

  void hit(const PhotonHit& h) {
    const float beta = luminance(h.beta);
    used = true;
    if (light != nullptr) light->add(h.hit.triangle, beta);
    if (weights != nullptr) square += (*weights)[h.hit.triangle] * beta * beta;
  }
  void endPhoton() {}
};

/// Time of a photon, in units of a ray that meets nothing: a hit with the ray to it, its deposit and what follows takes
/// about three of those (measured on furnished rooms).
std::uint64_t costOf(const Ledger& ledger) { return 1 + 3 * ledger.hits; }

/// Traces photons `range` of the pilot of one emitter; tell(place, cost, sink) after each, from any thread.
void tracePilot(const PhotonScene& scene, std::size_t emitter, IndexRange range, const GuidePilotOptions& options,
                PilotSink start,
                const std::function<void(const EmissionPlace&, std::uint64_t, const PilotSink&)>& tell) {
  constexpr SceneFeatures kAll = kPhotonVariants[kGeneralVariant].features;
  const TraceLimits limits;
  const PhotonSeed seed(options.seed ^ kPilotSeed, SamplerKind::sobol);
  const std::uint64_t first = std::uint64_t{emitter} * options.photons * 2;
  tbb::parallel_for(tbb::blocked_range<std::uint64_t>(range.begin, range.end, 1024), [&](const auto& block) {
    const FlushDenormals mode;
    PhotonNumberSeeds seeds(seed, (first + block.begin()) >> 32);
    for (std::uint64_t i = block.begin(); i < block.end(); ++i) {
      const PhotonSampler sampler(seed, first + i);
      if ((first + i) >> 32 != seeds.k()) seeds = PhotonNumberSeeds(seed, (first + i) >> 32);
      const EmissionNumbers numbers = sampler.emission();
      const EmissionPlace place = scene.emitters().placeFor(emitter, numbers.pick, numbers.others);
      PilotSink sink = start;
      Ledger ledger;
      PathLedger sums;
      PhotonPath<kAll, PilotSink>(scene, {seeds, first + i}, limits, sink, ledger, sums)
          .trace(scene.emitters().sampleUnguided(emitter, place));
      tell(place, costOf(ledger), sink);
    }
  });
}

/// A quarter of the pilot says how bright triangles are; then light is counted by cells, half of it to learn from and
/// half to judge what was learnt.
GuidePilotResult learnGuide(PhotonScene& scene, std::size_t emitter, const GuidePilotOptions& options) {
  const bool isSky = scene.emitters().hasSky() && emitter + 1 == scene.emitters().size();
  const GuideGrid grid = isSky ? GuideGrid{8, 32} : GuideGrid{1, 128};
  TriangleLight light(scene);
  tracePilot(scene, emitter, {0, options.photons / 4}, options, {&light, nullptr},
             [](const EmissionPlace&, std::uint64_t, const PilotSink&) {});
  const std::vector<float> weights = light.weights();
  const EmissionGuide places(grid, std::vector<double>(grid.cells(), 0.0));
  GuideCells learnt(grid), judged(grid);
  std::atomic<std::uint64_t> wasted{0}, turn{0};
  for (GuideCells* cells : {&learnt, &judged}) {
    const std::uint64_t begin = options.photons / 4 + turn++ * options.photons;
    tracePilot(scene, emitter, {begin, begin + options.photons}, options, {nullptr, &weights},
               [&](const EmissionPlace& place, std::uint64_t cost, const PilotSink& sink) {
                 cells->add(places.cellOf(place.direction, place.position), cost, sink.square);
                 if (!sink.used) wasted.fetch_add(1, std::memory_order_relaxed);
               });
  }
  GuideChoice choice = chooseGuide(learnt, judged);
  const double share = static_cast<double>(wasted.load()) / static_cast<double>(2 * options.photons);
  const bool worthwhile = choice.gain > kWorthwhileGain;
  if (worthwhile) scene.setGuide(emitter, std::move(choice.guide));
  return {emitter, share, choice.gain, worthwhile};
}

}  // namespace

std::vector<GuidePilotResult> learnGuides(PhotonScene& scene, const GuidePilotOptions& options) {
  std::vector<GuidePilotResult> results;
  for (std::size_t e = 0; e < scene.emitters().size() && results.size() < kMostGuides; ++e)
    if (scene.emitters().isDistant(e)) results.push_back(learnGuide(scene, e, options));
  return results;
}

}  // namespace lucarne
