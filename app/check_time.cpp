#include "app/check_time.h"

#include <algorithm>

#include "app/bake_scene.h"
#include "base/float_mode.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "base/system.h"
#include "base/units.h"
#include "tracer/transport/any_sink.h"

namespace lucarne {
namespace {

constexpr double kBareSeconds = 0.1, kStoredSeconds = 0.3;

/// Stores nothing; counts the photons that no lit side saw.
class WasteSink {
 public:
  explicit WasteSink(const Ledger& ledger) : ledger_(ledger) {}
  void hit(const PhotonHit&) { ++hits; }
  void endPhoton() {
    if (hits == hitsBefore_) ++(ledger_.hits == allHitsBefore_ ? missed : lost);
    hitsBefore_ = hits;
    allHitsBefore_ = ledger_.hits;
  }
  std::uint64_t hits = 0, missed = 0, lost = 0;

 private:
  const Ledger& ledger_;
  std::uint64_t hitsBefore_ = 0, allHitsBefore_ = 0;  // the latter with those on black backs
};

double sumOf(const FluxSum& f) { return static_cast<double>(f.units[0] + f.units[1] + f.units[2]); }

/// What a few photons told.
struct BareSample {
  double perSecond = 0, rays = 0, hits = 0;  // of one thread; a photon
  double missed = 0, lost = 0, escaped = 0;  // fractions
};

/// The first photons of the bake's seed, on one thread without storing.
BareSample traceBare(const CheckInput& in) {
  const FlushDenormals mode;
  constexpr std::uint64_t kStep = 512;
  Ledger ledger;
  WasteSink sink(ledger);
  const Stopwatch watch;
  double seconds = 0;
  while (seconds < kBareSeconds) {
    flyPhotons(in.photonScene, {ledger.photons, ledger.photons + kStep}, in.options.seed, {}, sink, ledger);
    seconds = watch.seconds();
  }
  const auto n = static_cast<double>(ledger.photons), emitted = sumOf(ledger.emitted);
  return {n / seconds,
          static_cast<double>(ledger.rays) / n,
          static_cast<double>(sink.hits) / n,
          static_cast<double>(sink.missed) / n,
          static_cast<double>(sink.lost) / n,
          emitted > 0 ? sumOf(ledger.escaped) / emitted : 0};
}

/// Photons a second of all threads, stored in tallies of that plan as a bake stores them. The first fill caches and
/// touch the pages of the tallies; the clock starts after them.
double traceStored(const CheckInput& in, const DirectionSet& directions, const TallyLayout& plan) {
  const PhotonRunOptions options = runOptions(in.options);
  Tallies tallies(plan);
  const TexelMap map(in.scene(), in.plan.charts, in.plan.layout, plan);
  PhotonRun run({in.photonScene, map, plan, directions}, options, tallies);
  const auto goOn = [](const RunProgress&) { return true; };
  constexpr int kMostChunks = 64;
  const std::uint64_t step = 4096 * static_cast<std::uint64_t>(std::min(options.threads, kMostChunks));
  std::uint64_t done = run.trace({0, step}, goOn), timed = 0;
  const Stopwatch watch;
  double seconds = 0;
  while (seconds < kStoredSeconds) {
    timed += run.trace({done + timed, done + timed + step}, goOn);
    seconds = watch.seconds();
  }
  return static_cast<double>(timed) / seconds;
}

struct StoredSample {
  double perSecond = 0;
  std::uint64_t tallyBytes = 0;  // of the tallies that were stored in; 0: none
};

/// Touching large tallies for the first time takes longer than a sample may. One direction a side is then stored in
/// their place: that is out of the caches as well. Where even those are large nothing is stored, and all threads are
/// taken to be as fast as one.
StoredSample sampleStored(const CheckInput& in, double barePerSecond) {
  constexpr std::uint64_t kLargest = std::uint64_t{256} << 20;
  const std::uint64_t most = std::min(kLargest, availableMemoryBytes() / 2);
  if (in.plan.tallies.bytes() <= most)
    return {traceStored(in, in.plan.directions, in.plan.tallies), in.plan.tallies.bytes()};
  const DirectionSet one(1);
  const TallyLayout plan = planTallies(in.scene(), in.plan.charts, in.plan.layout, one);
  if (plan.bytes() <= most) return {traceStored(in, one, plan), plan.bytes()};
  return {barePerSecond * std::min(threadCount(in.options), threadCount()), 0};
}

void warnOfWaste(const CheckInput& in, const BareSample& sample, CheckWarnings& warnings) {
  constexpr double kMostMissed = 0.5, kMostLost = 0.05;
  if (sample.missed > kMostMissed) {
    const auto sun = [](const Light& l) { return l.kind == LightKind::directional; };
    const bool suns = std::any_of(in.scene().lights.begin(), in.scene().lights.end(), sun);
    warnings.add("missed", formatPercent(sample.missed) + " of the light leaves the scene without meeting a surface; " +
                               (suns ? "directional lights shine on all of its bounding sphere, so remove far-off parts"
                                     : "point the lights at the scene, or close it") +
                               ", or trace more photons");
  }
  if (sample.lost > kMostLost)
    warnings.add("lost", formatPercent(sample.lost) +
                             " of the light falls on backs of one-sided surfaces, which are black: is a lamp inside a "
                             "closed shape, or are surfaces turned inside out? Make those materials double-sided");
}

void warnOfNoise(double perTexel, CheckWarnings& warnings) {
  constexpr double kFew = 30;
  if (perTexel < kFew)
    warnings.add("few_photons",
                 (perTexel > 0 ? "only " + formatNumber(perTexel) + " photons fall" : "no photon falls") +
                     std::string(" into a texel, on average: trace more, or lower --density"));
}

/// A bake ends when the light of all hits of a channel passes 63 bits; roulette keeps a hit's near the unit.
void failOnFullTallies(double hits, CheckWarnings& failures) {
  const double share = hits * static_cast<double>(kFixedPointOne) / 0x1p63;
  if (share >= 1)
    failures.add("tallies", "the tallies would be full after " + formatPercent(1 / share) +
                                " of the photons: bake fewer, or parts with light maps of their own");
}

}  // namespace

nlohmann::json checkTime(const CheckInput& in, const nlohmann::json& layout, CheckWarnings& warnings,
                         CheckWarnings& failures) {
  const auto photons = static_cast<double>(in.options.photons);
  nlohmann::json json = {
      {"seconds_of_setup", in.secondsOfSetup}, {"threads", threadCount(in.options)}, {"photons", in.options.photons}};
  if (in.photonScene.emitters().empty()) return json;
  const BareSample bare = traceBare(in);
  const StoredSample stored = sampleStored(in, bare.perSecond);
  const auto covered = layout["covered_texels"].get<double>();
  const double perTexel = covered > 0 ? photons * bare.hits / covered : 0;
  warnOfWaste(in, bare, warnings);
  warnOfNoise(perTexel, warnings);
  failOnFullTallies(photons * bare.hits, failures);
  json.update({{"seconds", photons / stored.perSecond},
               {"photons_per_second", stored.perSecond},
               {"sampled_tally_bytes", stored.tallyBytes},
               {"bare_photons_per_second", bare.perSecond},
               {"rays_per_photon", bare.rays},
               {"photons_per_texel", perTexel},
               {"missed", bare.missed},
               {"lost", bare.lost},
               {"escaped", bare.escaped}});
  return json;
}

}  // namespace lucarne
