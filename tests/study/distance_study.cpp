// How well one distance a cell tells how far away its light is: what Σβ/d would be worth to shadows of moving objects.
//
//   distance_study [--scene SCENE.glb] [--environment SKY] [--photons N] [--density D] [--directions N]
//
// d is the length of a photon's last segment: to the lamp or surface that it comes from. Of every cell (texel, ψ) the
// light by d is known here. An object at distance t from the texel, in the direction of the cell, shadows the light
// with d > t, a share F(t) of the cell's. A player that knows one distance D of the cell takes it for 1 where t < D and
// for 0 beyond. What it misjudges is |F(t) − [t < D]|, averaged over t from 0 to kFarthest, and over cells by their
// light, for
//   none      D infinite: nothing is known
//   kept      1/D = Σ(β/d)/Σβ, the tally in question
//   scene     D the distance to the scene's own surface along the mean direction of the cell's light
//   best      the D that misjudges least, of the cell's own photons
#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/error.h"
#include "dlm/deposit.h"
#include "tests/study/study.h"
#include "tracer/transport/any_sink.h"

namespace lucarne {
namespace {

constexpr double kFarthest = 3;             // metres that an object may be away
constexpr std::size_t kFewestPhotons = 12;  // of a cell that can say something of its spread

struct Arrival {
  std::uint64_t cell;
  float light, nearness;  // 1/d, 1/m; 0: from infinitely far
  Vec3f wi;
  Vec3f leave;  // where a ray back starts, local
};

/// How far it is along a ray to what light came from.
class Distances {
 public:
  explicit Distances(const PhotonScene& scene) : scene_(scene) {}
  double nearness(Vec3f from, Vec3f wi, std::uint32_t triangle) const {
    std::uint64_t repeats = 0;
    const std::uint32_t met = scene_.rayCaster().nearest(from, wi, triangle, repeats);
    double nearest = met == kNone ? 0 : 1 / length(scene_.rayCaster().intersect(met, from, wi).position - Vec3d(from));
    for (const Light& light : scene_.scene().lights) {
      if (light.kind == LightKind::directional) continue;
      const Vec3d to = scene_.scene().frame.toLocal(light.position) - Vec3d(from);
      constexpr double kSame = 1 - 1e-6;
      if (dot(to, Vec3d(wi)) > kSame * length(to)) nearest = std::max(nearest, 1 / length(to));
    }
    return nearest / scene_.scene().frame.scale;
  }

 private:
  const PhotonScene& scene_;
};

struct ArrivalSink {
  const TexelMap& map;
  const DirectionSet& set;
  const Distances& distances;
  std::vector<Arrival>& arrivals;
  void hit(const PhotonHit& h) {
    const TexelMap::Entry& entry = map[h.hit.triangle];
    const std::uint32_t index = h.hit.back ? entry.back : entry.front;
    if (index == kNone || map.side(index).rank == nullptr) return;
    const TexelMap::Side& side = map.side(index);
    const Vec2f st = entry.st0 + entry.e1 * h.hit.b.x + entry.e2 * h.hit.b.y;
    const int x = std::clamp(static_cast<int>(st.x), 0, side.width - 1);
    const int y = std::clamp(static_cast<int>(st.y), 0, side.height - 1);
    const std::uint64_t rank = side.rank[static_cast<std::size_t>(set.nearest(h.wi))];
    const Vec3f from = RayCaster::leave(h.hit.position, h.n, h.hit.clearance);
    arrivals.push_back({side.firstLight + rank * side.texelCount + static_cast<std::uint64_t>(y * side.width + x),
                        luminance(h.beta), static_cast<float>(distances.nearness(from, h.wi, h.hit.triangle)), h.wi,
                        from});
  }
  void endPhoton() {}
};

/// Σ over all cells, by their light.
struct Sums {
  double light = 0, tooFew = 0, spread = 0, none = 0, kept = 0, scene = 0, best = 0;
  std::vector<std::pair<double, double>> spreads;  // relative, and light
};

/// ∫ |F(t) − [t < D]| dt/kFarthest. F falls by the share of each photon at its own d.
double misjudged(const std::vector<std::pair<double, double>>& byDistance, double light, double D) {
  double sum = 0, t = 0, beyond = light;
  const auto add = [&](double until) {
    const double end = std::min(until, kFarthest), share = beyond / light;
    if (end <= t) return;
    const double before = std::clamp(D, t, end) - t;
    sum += before * (1 - share) + (end - t - before) * share;
    t = end;
  };
  for (const auto& [d, l] : byDistance) {
    add(d);
    beyond = std::max(0.0, beyond - l);
  }
  add(kFarthest);
  return sum / kFarthest;
}

void addCell(std::span<const Arrival> cell, const Distances& distances, Sums& sums) {
  double light = 0, first = 0, second = 0;
  Vec3d mean{};
  std::vector<std::pair<double, double>> byDistance;
  for (const Arrival& a : cell) {
    const auto l = static_cast<double>(a.light), near = static_cast<double>(a.nearness);
    light += l;
    first += l * near;
    second += l * near * near;
    mean += Vec3d(a.wi) * l;
    byDistance.emplace_back(near > 0 ? 1 / near : 1e30, l);
  }
  sums.light += light;
  if (cell.size() < kFewestPhotons || !(light > 0)) {
    sums.tooFew += light;
    return;
  }
  std::sort(byDistance.begin(), byDistance.end());
  const double nearness = first / light, variance = std::max(0.0, second / light - nearness * nearness);
  const double relative = nearness > 0 ? std::sqrt(variance) / nearness : 0;
  const Vec3f direction(normalize(mean));
  const double own = distances.nearness(cell[cell.size() / 2].leave, direction, kNone);
  const auto judge = [&](double D) { return misjudged(byDistance, light, D) * light; };
  double best = std::min(judge(0), judge(1e30));
  for (std::size_t i = 0; i < byDistance.size(); i += byDistance.size() / 16 + 1)
    best = std::min(best, judge(byDistance[i].first));
  sums.none += judge(1e30);
  sums.kept += judge(nearness > 0 ? 1 / nearness : 1e30);
  sums.scene += judge(own > 0 ? 1 / own : 1e30);
  sums.best += best;
  sums.spreads.emplace_back(relative, light);
}

double quantile(std::vector<std::pair<double, double>>& spreads, double share) {
  std::sort(spreads.begin(), spreads.end());
  double all = 0, sum = 0;
  for (const auto& s : spreads) all += s.second;
  for (const auto& s : spreads)
    if ((sum += s.second) >= share * all) return s.first;
  return 0;
}

Sums study(const PhotonScene& scene, const BakeOptions& o, std::uint64_t& entries) {
  const BakePlan plan = makePlan(scene.scene(), o);
  for (const TallySide& side : plan.tallies.sides)
    entries += side.texelCount() * plan.tallies.membersOf(side).members.size();
  const TexelMap map(scene.scene(), plan.charts, plan.layout, plan.tallies);
  const Distances distances(scene);
  std::vector<Arrival> arrivals;
  ArrivalSink sink{map, plan.directions, distances, arrivals};
  Ledger ledger;
  flyPhotons(scene, {0, o.photons}, runOptions(o).seed, {}, sink, ledger);
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.cell < b.cell; });
  Sums sums;
  for (std::size_t i = 0; i < arrivals.size();) {
    std::size_t end = i;
    while (end < arrivals.size() && arrivals[end].cell == arrivals[i].cell) ++end;
    addCell({arrivals.data() + i, end - i}, distances, sums);
    i = end;
  }
  return sums;
}

int run(int argc, char** argv) {
  CLI::App app("How well one distance a cell tells how far away its light is.", "distance_study");
  studies::Subject subject(app);
  BakeOptions& options = subject.options;
  CLI11_PARSE(app, argc, argv);
  subject.load();
  PhotonScene photonScene(subject.packed.scene, {}, subject.sky.get());
  prepareEmission(photonScene, options);
  std::printf("%10s %10s | %9s %9s %9s %8s | %8s %8s %8s %8s\n", "directions", "entries", "spread 25", "50", "75 %",
              "too few", "none", "kept", "scene", "best");
  for (const int directions : {14, 32, 64, 256}) {
    options.directions = directions;
    options.chooseDirections = false;
    std::uint64_t entries = 0;
    Sums s = study(photonScene, options, entries);
    const double known = s.light - s.tooFew;
    std::printf("%10d %10llu | %8.0f%% %8.0f%% %8.0f%% %7.0f%% | %7.1f%% %7.1f%% %7.1f%% %7.1f%%\n", directions,
                static_cast<unsigned long long>(entries), 100 * quantile(s.spreads, 0.25),
                100 * quantile(s.spreads, 0.5), 100 * quantile(s.spreads, 0.75), 100 * s.tooFew / s.light,
                100 * s.none / known, 100 * s.kept / known, 100 * s.scene / known, 100 * s.best / known);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace lucarne

int main(int argc, char** argv) {
  return lucarne::studies::runStudy("distance_study", [&] { return lucarne::run(argc, argv); });
}
