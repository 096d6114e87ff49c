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
constexpr int kLeastRounds = 9;
// All 14 directions on every side, as glossy scenes need them; on diffuse ones a bake would keep one map. Light maps of
// this many texels are far larger than the caches.
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

struct NoSink {
  void hit(const PhotonHit&) {}
  void endPhoton() {}
};

/// Rays of the photons of a range.
using Trace = std::function<std::uint64_t(IndexRange)>;

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

/// The tracer over one scene in the four ways that are compared.
class Contest {
 public:
  Contest(const PhotonScene& scene, const BakePlan& plan)
      : raw_(scene),
        map_(scene.scene(), plan.charts, plan.layout, plan.tallies),
        own_(plan.tallies),
        shared_(2 * plan.tallies.bytes() > PhotonRunOptions{}.privateTallyBytes) {
    if (!shared_) copy_ = std::make_unique<Tallies>(plan.tallies);
    const auto depositIn = [&](auto sink) -> Trace {
      return [&scene, sink, ledger = Ledger{}](IndexRange range) mutable {
        const std::uint64_t before = ledger.rays;
        tracePhotons(scene, range, PhotonSeed(0, BakeOptions{}.sampler), {}, *sink, ledger);
        return ledger.rays - before;
      };
    };
    const auto sink = [&]<bool shared>(const Tallies& tallies) {
      return std::make_shared<DepositSink<shared>>(map_, plan.tallies, plan.directions, LightPart::all, tallies);
    };
    trace_ = depositIn(std::make_shared<NoSink>());
    deposit_ = depositIn(sink.template operator()<false>(own_));
    if (shared_)
      depositOnTwo_ = {depositIn(sink.template operator()<true>(own_)),
                       depositIn(sink.template operator()<true>(own_))};
    else
      depositOnTwo_ = {depositIn(sink.template operator()<false>(own_)),
                       depositIn(sink.template operator()<false>(*copy_))};
  }
  Contest(const Contest&) = delete;
  Contest& operator=(const Contest&) = delete;

  struct Round {
    Work raw, trace, deposit, depositOnTwo;
  };
  /// `number` decides who begins.
  Round run(int number, double slice) {
    Round round;
    const auto enough = [slice](double seconds) { return seconds >= slice; };
    for (int i = 0; i < 4; ++i) {
      switch ((number + i) % 4) {
        case 0:
          round.raw = work(
              next_, [this](IndexRange r) { return raw_.trace(r.begin, r.end); }, enough);
          break;
        case 1:
          round.trace = work(next_, trace_, enough);
          break;
        case 2:
          round.deposit = work(next_, deposit_, enough);
          break;
        default:
          round.depositOnTwo = workOnTwo(next_, depositOnTwo_, slice);
      }
    }
    return round;
  }
  bool sharedTallies() const { return shared_; }

 private:
  RawTracer raw_;
  TexelMap map_;
  Tallies own_;
  bool shared_;
  std::unique_ptr<Tallies> copy_;  // of the second thread
  Trace trace_, deposit_;
  std::array<Trace, 2> depositOnTwo_;
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

BakePlan makeBenchPlan(const Scene& scene) {
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
  const BakePlan plan = makeBenchPlan(scene);
  auto photonScene = std::make_unique<PhotonScene>(scene);
  result.rayCaster = photonScene->rayCaster().description();
  result.texels = plan.layout.texelCount;
  result.tallyBytes = plan.tallies.bytes();
  {
    Contest contest(*photonScene, plan);
    result.sharedTallies = contest.sharedTallies();
    contest.run(0, 4 * kSlice);  // to fill the caches and touch the tallies
    const int count = std::max(kLeastRounds, static_cast<int>(seconds / (4 * kSlice)));
    const auto start = std::chrono::steady_clock::now();
    // A busy machine gets fewer rounds, not more time.
    const auto late = [&] {
      return std::chrono::steady_clock::now() - start > std::chrono::duration<double>(1.5 * seconds);
    };
    std::vector<Contest::Round> rounds;
    for (int i = 0; i < count && (i < kLeastRounds || !late()); ++i)
      rounds.push_back(contest.run(i, seconds / (4 * count)));
    summarize(rounds, result);
  }
  result.embreeBytes = embreeBytes(std::move(photonScene));
  return result;
}

}  // namespace lucarne::bench
