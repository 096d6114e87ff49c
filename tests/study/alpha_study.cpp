// Light through masked and blended surfaces: go on behind each hit, or let Embree ask at each hit (as the tracer does)?
//
//   alpha_study [ROUNDS]
//
// continuation  the nearest hit; where light goes through, a new ray from behind it.
// tracer        meetSurface(): an Embree intersection filter on all triangles, which says by itself whether light goes
//               through; one ray.
// filter        the same filter, only on the triangles whose materials have holes; the others lie in a geometry
// without.
//
// The number of a blend is a hash of (photon, event, triangle), so that all ways answer alike in whatever order they
// ask. All trace the same photons, diffuse paths with nothing else around, in turns on one thread.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>

#include "base/float_mode.h"
#include "tests/study/alpha_continuation.h"
#include "tests/support/scene_builder.h"
#include "tracer/optics/warp.h"

namespace lucarne::studies {
namespace {

// --- Ways to meet the next surface, and the path around them ---

using Meet = std::function<bool(const Ray&, Hit&)>;

bool meetByTracer(const PhotonScene& scene, const Ray& ray, Hit& hit) {
  std::uint64_t repeats = 0;
  const auto found = [](std::uint32_t) {};
  const auto ask = [&](const Hit& h) { return goesThrough(scene.surfaces(), h, ray.key); };
  return scene.surfaces().features().holes ? meetSurface<true>(scene, ray.start, repeats, found, ask, hit)
                                           : meetSurface<false>(scene, ray.start, repeats, found, ask, hit);
}

bool meetByFilter(const PhotonScene& scene, const FilterCaster& caster, const Ray& ray, Hit& hit,
                  std::uint64_t& asked) {
  const std::uint32_t triangle = caster.nearest(ray, asked);
  if (triangle != kNone) hit = scene.rayCaster().intersect(triangle, ray.start.origin, ray.start.direction);
  return triangle != kNone;
}

/// Returns the number of segments that end at a surface.
std::uint64_t tracePhoton(const PhotonScene& scene, std::uint64_t photon, const Meet& meet) {
  const EmittedPhoton emitted = scene.emitters().sample(RandomSampler(1, photon).emission());
  const RayCaster& caster = scene.rayCaster();
  RayStart start{RayCaster::leave(emitted.position, emitted.normal, caster.clearance(emitted.triangle)),
                 emitted.direction, emitted.triangle};
  for (std::uint64_t event = 1;; ++event) {
    const std::uint64_t key = mix64(photon << 16 | event);
    Hit hit;
    if (!meet({start, key}, hit)) return event - 1;
    if (isBlackBack(scene, hit) || unitHash(key + 1) >= scene.scene().materials[hit.material].baseColor.x) return event;
    const Vec3f n = hit.back ? -hit.n : hit.n;
    start = {RayCaster::leave(hit.position, n, hit.clearance),
             normalize(Frame<float>(n).toWorld(sampleCosineHemisphere({unitHash(key + 2), unitHash(key + 3)}))),
             hit.triangle};
  }
}

// --- Scenes ---

std::uint32_t addAlpha(test::SceneBuilder& builder, AlphaMode mode, float alpha, std::uint32_t texture, float tiles) {
  Material m = test::diffuseMaterial(Rgb{0.7f});
  m.doubleSided = true;
  m.alphaMode = mode;
  m.alpha = alpha;
  m.baseColorTexture = {texture, 0, {tiles, 0}, {0, tiles}, {}};
  return builder.addMaterial(m);
}

/// A white picture with the alpha `covers(x, y)`.
template <class Covers>
void addPicture(Scene& scene, Covers&& covers) {
  constexpr int kSize = 64;
  Image image{kSize, kSize, {}};
  for (int i = 0; i < kSize * kSize; ++i) {
    const bool covered = covers((i % kSize + 0.5) / kSize, (i / kSize + 0.5) / kSize);
    for (const int value : {255, 255, 255, covered ? 255 : 0}) image.rgba.push_back(static_cast<std::uint8_t>(value));
  }
  scene.images.push_back(image);
  scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1)});
}

/// A room of 4 × 3 × 4 m with a lamp of 1 m² in its ceiling, filled by `fill(builder)`. Texture 0 is a leaf that covers
/// one half, texture 1 a grid of wires that covers one tenth.
template <class Fill>
Scene room(Fill&& fill) {
  test::SceneBuilder builder;
  builder.addBox({-2, 0, -2}, {2, 3, 2}, builder.addDiffuse(Rgb{0.7f}), true);
  const std::uint32_t lamp = builder.addDiffuse(Rgb{0.5f}, Rgb{100.f});
  builder.addQuad({-0.5, 2.99, -0.5}, {0.5, 2.99, -0.5}, {0.5, 2.99, 0.5}, {-0.5, 2.99, 0.5}, lamp);
  fill(builder);
  Scene scene = builder.build();
  addPicture(scene, [](double x, double y) { return std::abs(y - 0.5) < 0.3927 * sinPi(x); });
  addPicture(scene, [](double x, double y) { return x < 0.05 || y < 0.05; });
  return scene;
}

void addLeaves(test::SceneBuilder& builder, std::uint32_t material) {
  constexpr std::uint64_t kLeaves = 3000;
  for (std::uint64_t i = 0; i < kLeaves; ++i) {
    const auto u = [i](std::uint64_t k) { return unitHash(8 * i + k); };
    const Vec3d middle{3.6 * (u(0) - 0.5), 0.3 + 2.4 * u(1), 3.6 * (u(2) - 0.5)};
    const Frame<double> frame(Vec3d(normalize(sampleSphere({u(3), u(4)}))));
    const Vec3d s = frame.s * (0.07 + 0.1 * u(5)), t = frame.t * (0.07 + 0.1 * u(5));
    builder.addQuad(middle - s - t, middle + s - t, middle + s + t, middle - s + t, material);
  }
}

void addScreens(test::SceneBuilder& builder) {
  const std::uint32_t mask = addAlpha(builder, AlphaMode::mask, 1, 1, 16);
  const std::uint32_t blend = addAlpha(builder, AlphaMode::blend, 0.1f, kNone, 1);
  for (int i = 0; i < 20; ++i) {
    const double y = 0.5 + 0.1 * i;
    builder.addQuad({-1.9, y, 1.9}, {1.9, y, 1.9}, {1.9, y, -1.9}, {-1.9, y, -1.9}, i % 2 == 0 ? mask : blend);
  }
}

/// Leaves that lie in the plane of the floor, as pictures on a wall do in many files.
void addDecals(test::SceneBuilder& builder) {
  const std::uint32_t mask = addAlpha(builder, AlphaMode::mask, 1, 0, 4);
  builder.addQuad({-1.5, 0, 1.5}, {1.5, 0, 1.5}, {1.5, 0, -1.5}, {-1.5, 0, -1.5}, mask);
}

// --- Measuring ---

/// Asks both ways at every segment of paths of the first, and says where they differ.
void compare(const PhotonScene& scene, const FilterCaster& caster, std::uint64_t photons) {
  std::uint64_t segments = 0, layers = 0, asked = 0, touching = 0, other = 0, lost = 0;
  const Meet both = [&](const Ray& ray, Hit& hit) {
    std::vector<Hit> passed;
    const bool met = meetByContinuation(scene, ray, hit, [&](const Hit& h) { passed.push_back(h); });
    Hit answer{};
    const bool answered = meetByFilter(scene, caster, ray, answer, asked);
    ++segments;
    layers += passed.size();
    if (met == answered && (!met || hit.triangle == answer.triangle)) return met;
    // Continuation passes over triangles that touch the one that it leaves; equal distances may be told apart either
    // way.
    const auto touches = [&](const Hit& h) {
      const double far = 4 * static_cast<double>(std::max(h.clearance, answer.clearance));
      return answered && h.triangle != answer.triangle &&
             std::abs(dot(answer.position - h.position, Vec3d(ray.start.direction))) < far;
    };
    const bool tie = std::any_of(passed.begin(), passed.end(), touches) || (met && touches(hit));
    ++(tie ? touching : other);
    lost += answered && !met;
    return met;
  };
  for (std::uint64_t i = 0; i < photons; ++i) tracePhoton(scene, i, both);
  const auto perSegment = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(segments); };
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("  %llu segments; each passes %.2f layers; the filter is asked %.2f times\n", count(segments),
              perSegment(layers), perSegment(asked));
  std::printf("  other answers: %llu where triangles touch, %llu elsewhere; continuation meets nothing at %llu\n",
              count(touching), count(other), count(lost));
}

double threadCpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

constexpr std::uint64_t kPhotons = 10'000;  // of a way in a round: about 50 ms

struct Way {
  const char* name;
  Meet meet;
  std::vector<double> rates, ratios;  // segments per second of CPU; to the first way of the same round
};

/// Median and quartiles.
std::array<double, 3> spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](std::size_t quarter) { return values[(values.size() - 1) * quarter / 4]; };
  return {at(2), at(1), at(3)};
}

/// `round` decides who begins and which photons fly.
void race(const PhotonScene& scene, std::vector<Way>& ways, std::uint64_t round) {
  for (std::size_t k = 0; k < ways.size(); ++k) {
    Way& way = ways[(k + round) % ways.size()];
    std::uint64_t segments = 0;
    const double start = threadCpuSeconds();
    for (std::uint64_t i = 0; i < kPhotons; ++i) segments += tracePhoton(scene, round * kPhotons + i, way.meet);
    way.rates.push_back(static_cast<double>(segments) / (threadCpuSeconds() - start));
  }
  for (Way& way : ways) way.ratios.push_back(way.rates.back() / ways[0].rates.back());
}

void study(const char* name, const Scene& made, std::uint64_t rounds) {
  const PhotonScene scene(made);
  const FilterCaster whereNeeded(scene);
  std::uint64_t asked = 0;
  const auto filtered = [&](const Ray& ray, Hit& hit) { return meetByFilter(scene, whereNeeded, ray, hit, asked); };
  const auto traced = [&](const Ray& ray, Hit& hit) { return meetByTracer(scene, ray, hit); };
  const auto continued = [&](const Ray& ray, Hit& hit) {
    return meetByContinuation(scene, ray, hit, [](const Hit&) {});
  };
  std::vector<Way> ways{{"continuation", continued, {}, {}}, {"tracer", traced, {}, {}}, {"filter", filtered, {}, {}}};
  std::printf("\n%s: %zu triangles\n", name, made.triangles.size());
  compare(scene, whereNeeded, 20 * kPhotons);  // warms the caches, too
  for (std::uint64_t round = 0; round < rounds; ++round) race(scene, ways, round);
  for (const Way& way : ways) {
    const std::array<double, 3> ratio = spread(way.ratios);
    std::printf("  %-14s %6.3f M segments/s, ratio %.3f (%.3f-%.3f)\n", way.name, 1e-6 * spread(way.rates)[0], ratio[0],
                ratio[1], ratio[2]);
  }
}

void studyAll(std::uint64_t rounds) {
  const auto leaves = [](AlphaMode mode) {
    return room([mode](test::SceneBuilder& b) { addLeaves(b, addAlpha(b, mode, 1, 0, 1)); });
  };
  std::printf("Segments of paths that end at a surface, per second of CPU; ratio: median (quartiles) of %llu rounds\n",
              static_cast<unsigned long long>(rounds));
  study("foliage", leaves(AlphaMode::mask), rounds);
  study("layers", room(addScreens), rounds);
  study("decals", room(addDecals), rounds);
  study("opaque", leaves(AlphaMode::opaque), rounds);
}

}  // namespace
}  // namespace lucarne::studies

int main(int argc, char** argv) {
  const lucarne::FlushDenormals flush;
  constexpr std::uint64_t kRounds = 41;
  const std::uint64_t rounds = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : kRounds;
  if (rounds == 0) {
    std::fprintf(stderr, "usage: alpha_study [ROUNDS]\n");
    return 1;
  }
  lucarne::studies::studyAll(rounds);
}
