#include "tests/bench/bench_measure.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <memory>
#include <thread>

#include "app/bake_scene.h"
#include "base/float_mode.h"
#include "tests/bench/raw_tracer.h"
#include "tracer/transport/photon_tracer.h"

namespace lucarne::bench {
namespace {

constexpr std::uint64_t kChunk = 1024;  // photons between two looks at the clock
constexpr double kSlice = 0.1;          // seconds: what else the machine does changes little within a round
constexpr int kLeastRounds = 9, kWays = 5;
// With all directions: far larger than the caches.
constexpr std::uint64_t kTexels = 400'000;

double threadCpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Work {
  std::uint64_t photons = 0, rays = 0;
  double seconds = 0;  // of CPU
  double rate() const { return static_cast<double>(rays) / seconds; }
  Work& operator+=(const Work& o) {
    photons += o.photons;
    rays += o.rays;
    seconds += o.seconds;
    return *this;
  }
};

struct BenchPlans {
  BakePlan usual, large;
};

struct NoSink {
  void hit(const PhotonHit&) {}
  void endPhoton() {}
};

/// Rays of the photons of a range.
using Trace = std::function<std::uint64_t(IndexRange)>;

/// Photons of the scene into the sink, which the function keeps.
template <class Sink>
Trace tracing(const PhotonScene& scene, std::shared_ptr<Sink> sink) {
  return [&scene, sink, ledger = Ledger{}](IndexRange range) mutable {
    const std::uint64_t before = ledger.rays;
    tracePhotons(scene, range, PhotonSeed(0, BakeOptions{}.sampler), {}, *sink, ledger);
    return ledger.rays - before;
  };
}

/// Photons on this thread until `enough(seconds of its CPU time)`. No photon is taken twice.
template <class Enough>
Work work(std::atomic<std::uint64_t>& next, const Trace& trace, Enough&& enough) {
  const FlushDenormals mode;
  Work done;
  const double start = threadCpuSeconds();
  do {
    const std::uint64_t begin = next.fetch_add(kChunk);
    done.rays += trace({begin, begin + kChunk});
    done.photons += kChunk;
    done.seconds = threadCpuSeconds() - start;
  } while (!enough(done.seconds));
  return done;
}

/// Both threads work until the slower one has had its slice, so that neither is ever alone. Sums of both.
Work workOnTwo(std::atomic<std::uint64_t>& next, const std::array<Trace, 2>& trace, double slice) {
  std::atomic<int> waiting{2}, working{2};
  std::array<Work, 2> done;
  const auto run = [&](std::size_t i) {
    bool ready = false;
    for (--waiting; waiting > 0;) std::this_thread::yield();
    done[i] = work(next, trace[i], [&](double seconds) {
      if (seconds >= slice && !ready) {
        ready = true;
        --working;
      }
      return working == 0;
    });
  };
  std::thread other(run, 1);
  run(0);
  other.join();
  return done[0] += done[1];
}

/// Photons of a scene, counted in light maps of one plan.
class Counted {
 public:
  Counted(const PhotonScene& scene, const BakePlan& plan)
      : scene_(scene), plan_(plan), map_(scene.scene(), plan.charts, plan.layout, plan.tallies), own_(plan.tallies) {}
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

  /// On one thread.
  Trace alone() { return counting<false>(own_); }
  /// On two, as a bake would: with tallies of their own where they may have them.
  std::array<Trace, 2> together() {
    if (shared()) return {counting<true>(own_), counting<true>(own_)};
    if (!copy_) copy_ = std::make_unique<Tallies>(plan_.tallies);
    return {counting<false>(own_), counting<false>(*copy_)};
  }
  bool shared() const { return 2 * plan_.tallies.bytes() > PhotonRunOptions{}.privateTallyBytes; }

 private:
  template <bool shared>
  Trace counting(const Tallies& tallies) {
    return tracing(
        scene_, std::make_shared<DepositSink<shared>>(map_, plan_.tallies, plan_.directions, LightPart::all, tallies));
  }

  const PhotonScene& scene_;
  const BakePlan& plan_;
  TexelMap map_;
  Tallies own_;
  std::unique_ptr<Tallies> copy_;  // of the second thread
};

/// The tracer over one scene in the five ways that are compared.
class Contest {
 public:
  Contest(const PhotonScene& scene, const BenchPlans& plans)
      : raw_(scene), usual_(scene, plans.usual), large_(scene, plans.large) {
    const Trace bare = [this](IndexRange r) { return raw_.trace(r.begin, r.end); };
    alone_ = {bare, tracing(scene, std::make_shared<NoSink>()), usual_.alone(), large_.alone()};
    together_ = usual_.together();
  }

  struct Round {
    Work raw, trace, deposit, depositLarge, depositOnTwo;
  };
  /// `number` decides who begins.
  Round run(int number, double slice) {
    constexpr std::array kAlone = {&Round::raw, &Round::trace, &Round::deposit, &Round::depositLarge};
    Round round;
    const auto enough = [slice](double seconds) { return seconds >= slice; };
    for (std::size_t i = 0; i <= kAlone.size(); ++i) {
      const std::size_t which = (static_cast<std::size_t>(number) + i) % (kAlone.size() + 1);
      if (which < kAlone.size())
        round.*kAlone[which] = work(next_, alone_[which], enough);
      else
        round.depositOnTwo = workOnTwo(next_, together_, slice);
    }
    return round;
  }
  bool sharedTallies() const { return usual_.shared(); }

 private:
  RawTracer raw_;
  Counted usual_, large_;
  std::array<Trace, 4> alone_;
  std::array<Trace, 2> together_;
  std::atomic<std::uint64_t> next_{0};
};

template <class Value>
Spread spread(const std::vector<Contest::Round>& rounds, Value&& value) {
  std::vector<double> all;
  for (const Contest::Round& r : rounds) all.push_back(value(r));
  std::sort(all.begin(), all.end());
  const auto at = [&](double share) {
    return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1) + 0.5)];
  };
  return {at(0.5), at(0.25), at(0.75)};
}

void summarize(const std::vector<Contest::Round>& rounds, SceneResult& result) {
  using Round = Contest::Round;
  result.rounds = static_cast<int>(rounds.size());
  result.rawRaysPerSecond = spread(rounds, [](const Round& r) { return r.raw.rate(); });
  result.traceRaysPerSecond = spread(rounds, [](const Round& r) { return r.trace.rate(); });
  result.depositRaysPerSecond = spread(rounds, [](const Round& r) { return r.deposit.rate(); });
  result.traceOverRaw = spread(rounds, [](const Round& r) { return r.trace.rate() / r.raw.rate(); });
  result.depositOverRaw = spread(rounds, [](const Round& r) { return r.deposit.rate() / r.raw.rate(); });
  result.largeOverRaw = spread(rounds, [](const Round& r) { return r.depositLarge.rate() / r.raw.rate(); });
  result.twoThreadsOverOne =
      spread(rounds, [](const Round& r) { return 2 * r.depositOnTwo.rate() / r.deposit.rate(); });
  Round sum;
  for (const Round& r : rounds) {
    sum.raw += r.raw;
    sum.trace += r.trace;
  }
  const auto raysPerPhoton = [](const Work& w) { return static_cast<double>(w.rays) / static_cast<double>(w.photons); };
  result.rawRaysPerPhoton = raysPerPhoton(sum.raw);
  result.raysPerPhoton = raysPerPhoton(sum.trace);
}

template <class... T>
std::uint64_t bytesOf(const std::vector<T>&... arrays) {
  return (... + (arrays.size() * sizeof(T)));
}

}  // namespace

std::uint64_t sceneBytes(const Scene& scene) {
  return bytesOf(scene.positions, scene.normals, scene.uv0, scene.uv1, scene.atlasUv, scene.tangents,
                 scene.sourceVertex, scene.triangles, scene.smooth);
}

BakePlan makeDefaultPlan(const Scene& scene) { return makePlan(scene, {}); }

BakePlan makeLargePlan(const Scene& scene) {
  BakeOptions options;
  options.texelsPerMetre = 1e6;  // the budget decides
  options.texelBudget = kTexels;
  options.keepAllDirections = true;
  return makePlan(scene, options);
}

/// What Embree gives back when a scene ends is what it held.
std::uint64_t embreeBytes(std::unique_ptr<PhotonScene> scene) {
  std::atomic<std::int64_t> bytes{0};
  const auto watch = [](void* sum, ssize_t change, bool) {
    *static_cast<std::atomic<std::int64_t>*>(sum) -= change;
    return true;
  };
  const RTCDevice device = rtcGetSceneDevice(scene->rayCaster().embreeScene());
  rtcRetainDevice(device);
  rtcSetDeviceMemoryMonitorFunction(device, watch, &bytes);
  scene.reset();
  rtcReleaseDevice(device);
  return static_cast<std::uint64_t>(std::max(std::int64_t{0}, bytes.load()));
}

SceneResult measure(const std::string& name, const Scene& scene, double seconds) {
  SceneResult result;
  result.name = name;
  result.triangles = scene.triangles.size();
  result.sceneBytes = sceneBytes(scene);
  const BenchPlans plans{makeDefaultPlan(scene), makeLargePlan(scene)};
  auto photonScene = std::make_unique<PhotonScene>(scene);
  result.rayCaster = photonScene->rayCaster().description();
  result.texels = plans.usual.layout.texelCount;
  result.tallyBytes = plans.usual.tallies.bytes();
  result.largeTallyBytes = plans.large.tallies.bytes();
  {
    Contest contest(*photonScene, plans);
    result.sharedTallies = contest.sharedTallies();
    contest.run(0, 4 * kSlice);  // to fill the caches and touch the tallies
    const int count = std::max(kLeastRounds, static_cast<int>(seconds / (kWays * kSlice)));
    const auto start = std::chrono::steady_clock::now();
    // A busy machine gets fewer rounds, not more time.
    const auto late = [&] {
      return std::chrono::steady_clock::now() - start > std::chrono::duration<double>(1.5 * seconds);
    };
    std::vector<Contest::Round> rounds;
    for (int i = 0; i < count && (i < kLeastRounds || !late()); ++i)
      rounds.push_back(contest.run(i, seconds / (kWays * count)));
    summarize(rounds, result);
  }
  result.embreeBytes = embreeBytes(std::move(photonScene));
  return result;
}

}  // namespace lucarne::bench
