// What a deposit costs: rays per second of CPU time of (1) bare rtcIntersect1 on recorded bounce rays, (2) a lean
// diffuse path around rtcIntersect1, (3) the whole path logic without storing anything, (4) the same with deposits in light maps. Same scene, same photons, same Embree flags.
//
//   build/release/tests/bench/lucarne_bench --benchmark_filter=Rays --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
//
// LUCARNE_BENCH_SCENE names another scene than the built-in room.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <cstdlib>
#include <memory>
#include <thread>

#include "app/bake_scene.h"
#include "app/builtin_scene.h"
#include "tracer/optics/warp.h"
#include "tracer/transport/photon_tracer.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {
namespace {

struct Ray {
  Vec3f origin, direction;
};

struct Fixture {
  Scene scene;
  BakeOptions options;
  std::unique_ptr<PhotonScene> photonScene;
  std::unique_ptr<BakePlan> plan;
  std::unique_ptr<TexelMap> map;
  std::vector<Ray> rays;
};

struct NoSink {
  void hit(const PhotonHit&) {}
  void endPhoton() {}
};

/// The segments that end at hits, as the tracer cast them: from the hit back along wi.
struct RaySink {
  std::vector<Ray>& rays;
  Vec3f last{};
  void hit(const PhotonHit& h) {
    if (h.event > 1) rays.push_back({last, -h.wi});
    last = RayCaster::leave(h.hit.position, h.n, h.hit.clearance);
  }
  void endPhoton() {}
};

Scene loadScene() {
  const char* path = std::getenv("LUCARNE_BENCH_SCENE");
  return path != nullptr ? readGltf(path) : readGlb(builtinScene(), "the built-in scene");
}

const Fixture& fixture() {
  static const std::unique_ptr<Fixture> shared = [] {
    auto f = std::make_unique<Fixture>();
    f->scene = loadScene();
    f->photonScene = std::make_unique<PhotonScene>(f->scene);
    f->plan = std::make_unique<BakePlan>(makePlan(f->scene, f->options));
    f->map = std::make_unique<TexelMap>(f->scene, f->plan->charts, f->plan->layout, f->plan->tallies);
    RaySink sink{f->rays};
    Ledger ledger;
    tracePhotons(*f->photonScene, {0, 200'000}, 0, {}, sink, ledger);
    return f;
  }();
  return *shared;
}

constexpr std::uint64_t kPhotons = 100'000;

RTCRayHit rayHit(Vec3f o, Vec3f d) {
  return {{o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, 1e30f, ~0u, 0, 0}, {0, 0, 0, 0, 0, 0, RTC_INVALID_GEOMETRY_ID, {RTC_INVALID_GEOMETRY_ID}}};
}

/// The leanest photon that still bounces: real emission, then rtcIntersect1, Philox, a cosine direction about the normal, one albedo,
/// roulette. No textures, no BSDF, no ledger, no recomputed hit.
std::uint64_t leanPhoton(const Fixture& f, std::uint64_t i) {
  const PhotonSampler sampler(0, i);
  const EmittedPhoton p = f.photonScene->emitters().sample(sampler.emission());
  Vec3f o = RayCaster::leave(p.position, p.normal, 1e-6f), d = p.direction;
  for (std::uint32_t event = 1;; ++event) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray = rayHit(o, d);
    rtcIntersect1(f.photonScene->rayCaster().embreeScene(), &context, &ray);
    const auto v = sampler.floats(event, Stream::scatter);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID || v[3] > 0.68f) return event;
    Vec3f n = normalize(Vec3f{ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
    if (dot(n, d) > 0) n = -n;
    o = o + d * ray.ray.tfar + n * 1e-6f;
    d = Frame<float>(n).toWorld(sampleCosineHemisphere({v[0], v[1]}));
  }
}

void BareIntersectRays(benchmark::State& state) {
  const Fixture& f = fixture();
  std::uint64_t hits = 0;
  for (auto _ : state) {
    for (const Ray& r : f.rays) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit ray = rayHit(r.origin, r.direction);
      rtcIntersect1(f.photonScene->rayCaster().embreeScene(), &context, &ray);
      hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  benchmark::DoNotOptimize(hits);
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(f.rays.size() * state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(BareIntersectRays)->Unit(benchmark::kMillisecond);

void LeanPathRays(benchmark::State& state) {
  const Fixture& f = fixture();
  std::uint64_t rays = 0;
  for (auto _ : state)
    for (std::uint64_t i = 0; i < kPhotons; ++i) rays += leanPhoton(f, i);
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}
BENCHMARK(LeanPathRays)->Unit(benchmark::kMillisecond);

void PathLogicRays(benchmark::State& state) {
  const Fixture& f = fixture();
  Ledger ledger;
  NoSink sink;
  for (auto _ : state) tracePhotons(*f.photonScene, {0, kPhotons}, 0, {}, sink, ledger);
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(ledger.rays), benchmark::Counter::kIsRate);
}
BENCHMARK(PathLogicRays)->Unit(benchmark::kMillisecond);

void DepositRays(benchmark::State& state) {
  const Fixture& f = fixture();
  Ledger ledger;
  const Tallies tallies(f.plan->tallies);
  DepositSink<false> sink(*f.map, f.plan->tallies, f.plan->directions, LightPart::all, tallies);
  for (auto _ : state) {
    tracePhotons(*f.photonScene, {0, kPhotons}, 0, {}, sink, ledger);
    sink.flush();
  }
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(ledger.rays), benchmark::Counter::kIsRate);
}
BENCHMARK(DepositRays)->Unit(benchmark::kMillisecond);

/// Both threads against one, by the CPU time of the whole process per ray.
void ThreadedDepositRays(benchmark::State& state) {
  const Fixture& f = fixture();
  PhotonRunOptions options;
  options.threads = static_cast<int>(state.range(0));
  std::uint64_t rays = 0;
  for (auto _ : state) {
    Ledger ledger;
    Tallies tallies(f.plan->tallies);
    runPhotons({*f.photonScene, *f.map, f.plan->tallies, f.plan->directions}, {0, 8 * kPhotons}, options, tallies, ledger,
               [](const RunProgress&) { return true; });
    rays += ledger.rays;
  }
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}
BENCHMARK(ThreadedDepositRays)->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lucarne
