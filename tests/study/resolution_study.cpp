// Uniform resolution for all light maps of a chart, or that of the chart's area projected along each ψ?
//
//   resolution_study [--scene SCENE.glb] [--environment SKY] [--photons N] [--density D] [--directions N] [--truth K]
//
// Photons are counted on texels `kFine` times as fine as the maps in question, four times: twice N photons, and twice
// K·N for the truth. Every way of cutting the rectangle of a chart into texels is then a matter of adding fine ones up;
// each map is smoothed by a pyramid of 1.5 of its own texels, as `bake --kernel pyramid` does, and read bilinearly at
// every fine texel.
//
//   uniform s     all maps of a chart with density D·s
//   projected s   the map of ψ with density D·s·√c, c the mean cosine of ψ's cell above the chart: c of the texels
//
// With maps M1, M2 of the two bakes and truths T1, T2, all four independent, (M1 − T1)(M1 − T2) is on average the
// squared error of a map and (M1 − T1)(M2 − T2) that part of it which is bias: the noise of the truths drops out. Two
// sums are taken over all texels and ψ of flat sides: of B itself, and of the radiance B/C that reflections show, each
// ψ by its C = ∫cos over its cell. Both are over the same sum of T1·T2, in per cent of the root. Texels are those of
// maps that got light: others are not stored.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <numeric>

#include "base/error.h"
#include "tests/study/study.h"

namespace lucarne {
namespace {

constexpr int kFine = 3;
constexpr double kKernel = 1.5;  // texels from a texel's centre to where the pyramid ends

using Grid = std::vector<double>;

/// For each coarse texel along an edge, the fine ones in it: they are cut where its ends fall.
struct Overlap {
  int first;
  std::vector<double> shares;
};
std::vector<Overlap> overlaps(int fine, int coarse) {
  std::vector<Overlap> all;
  const double step = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    const double begin = i * step, end = std::min<double>(fine, (i + 1) * step);
    Overlap o{static_cast<int>(begin), {}};
    for (int k = o.first; k < fine && k < end; ++k)
      o.shares.push_back(std::min<double>(k + 1, end) - std::max<double>(k, begin));
    all.push_back(std::move(o));
  }
  return all;
}

struct Size {
  int width, height;
  std::uint64_t texels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

Grid binned(const Grid& fine, Size from, Size to) {
  const auto columns = overlaps(from.width, to.width), rows = overlaps(from.height, to.height);
  Grid out(to.texels());
  for (int y = 0; y < to.height; ++y) {
    const Overlap& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < to.width; ++x) {
      const Overlap& column = columns[static_cast<std::size_t>(x)];
      double sum = 0;
      for (std::size_t j = 0; j < row.shares.size(); ++j)
        for (std::size_t i = 0; i < column.shares.size(); ++i)
          sum += row.shares[j] * column.shares[i] *
                 fine[static_cast<std::size_t>((row.first + static_cast<int>(j)) * from.width + column.first) + i];
      out[static_cast<std::size_t>(y * to.width + x)] = sum;
    }
  }
  return out;
}

/// One direction of the pyramid: neighbours weigh a third of the texel itself.
Grid smoothedAlong(const Grid& g, Size size, int dx, int dy) {
  constexpr double kNeighbour = (kKernel - 1) / kKernel;
  Grid out(g);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (const int sign : {-1, 1}) {
        const int nx = x + sign * dx, ny = y + sign * dy;
        if (nx < 0 || ny < 0 || nx >= size.width || ny >= size.height) continue;
        out[static_cast<std::size_t>(y * size.width + x)] +=
            kNeighbour * g[static_cast<std::size_t>(ny * size.width + nx)];
      }
  return out;
}
Grid smoothed(const Grid& g, Size size) { return smoothedAlong(smoothedAlong(g, size, 1, 0), size, 0, 1); }

/// Light per area, one value a coarse texel; 0 where there is no surface.
Grid mapOf(const Grid& tally, const Grid& area, Size fine, Size coarse) {
  Grid light = smoothed(binned(tally, fine, coarse), coarse);
  const Grid surface = smoothed(binned(area, fine, coarse), coarse);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = surface[i] > 0 ? light[i] / surface[i] : 0;
  return light;
}

double bilinear(const Grid& map, Size size, double x, double y) {
  const double px = std::clamp(x - 0.5, 0.0, size.width - 1.0), py = std::clamp(y - 0.5, 0.0, size.height - 1.0);
  const int x0 = std::min(static_cast<int>(px), std::max(0, size.width - 2)),
            y0 = std::min(static_cast<int>(py), std::max(0, size.height - 2));
  const int x1 = std::min(x0 + 1, size.width - 1), y1 = std::min(y0 + 1, size.height - 1);
  const double fx = px - x0, fy = py - y0;
  const auto at = [&](int i, int j) { return map[static_cast<std::size_t>(j * size.width + i)]; };
  return (at(x0, y0) * (1 - fx) + at(x1, y0) * fx) * (1 - fy) + (at(x0, y1) * (1 - fx) + at(x1, y1) * fx) * fy;
}

struct Way {
  bool projected;
  double scale;
  std::uint64_t texels = 0;
  struct Sums {
    double error = 0, bias = 0, power = 0;
  };
  Sums light = {}, radiance = {};
};

/// The counts of one map in the four bakes, light per photon, and the surface in fine texels.
struct FineMap {
  Size size;
  std::array<Grid, 2> bakes, truths;
  const Grid& area;
  double meanCosine, cosIntegral;
  bool lit() const {
    return std::any_of(bakes[0].begin(), bakes[0].end(), [](double v) { return v > 0; });
  }
};

Size coarseSize(const Way& way, const FineMap& map) {
  const double s = way.scale * (way.projected ? std::sqrt(map.meanCosine) : 1) / kFine;
  const auto along = [s](int fine) { return std::max(1, static_cast<int>(std::lround(fine * s))); };
  return {along(map.size.width), along(map.size.height)};
}

void addMap(const FineMap& map, Way& way) {
  const Size coarse = coarseSize(way, map);
  if (map.lit()) way.texels += coarse.texels();
  const Grid m1 = mapOf(map.bakes[0], map.area, map.size, coarse), m2 = mapOf(map.bakes[1], map.area, map.size, coarse);
  const double sx = static_cast<double>(coarse.width) / map.size.width,
               sy = static_cast<double>(coarse.height) / map.size.height;
  double error = 0, bias = 0, power = 0;
  for (int y = 0; y < map.size.height; ++y) {
    for (int x = 0; x < map.size.width; ++x) {
      const auto i = static_cast<std::size_t>(y * map.size.width + x);
      const double area = map.area[i];
      if (!(area > 0)) continue;
      const double t1 = map.truths[0][i] / area, t2 = map.truths[1][i] / area;
      const double v1 = bilinear(m1, coarse, (x + 0.5) * sx, (y + 0.5) * sy),
                   v2 = bilinear(m2, coarse, (x + 0.5) * sx, (y + 0.5) * sy);
      error += area * ((v1 - t1) * (v1 - t2) + (v2 - t1) * (v2 - t2)) / 2;
      bias += area * ((v1 - t1) * (v2 - t2) + (v2 - t1) * (v1 - t2)) / 2;
      power += area * t1 * t2;
    }
  }
  const auto add = [&](Way::Sums& sums, double weight) {
    sums.error += weight * error;
    sums.bias += weight * bias;
    sums.power += weight * power;
  };
  add(way.light, 1);
  if (map.cosIntegral > 0) add(way.radiance, 1 / map.cosIntegral);
}

std::unique_ptr<Tallies> countedIn(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& o,
                                   IndexRange range) {
  auto tallies = std::make_unique<Tallies>(plan.tallies);
  const TexelMap map(scene.scene(), plan.charts, plan.layout, plan.tallies);
  Ledger ledger;
  runPhotons({scene, map, plan.tallies, plan.directions}, range, runOptions(o), *tallies, ledger,
             [](const RunProgress&) { return true; });
  return tallies;
}

Grid gridOf(const Tallies& tallies, const TallySide& side, std::uint64_t rank, double photons) {
  Grid g;
  const auto units = tallies.light().subspan((side.firstLight + rank * side.texelCount()) * kLightChannels,
                                             side.texelCount() * kLightChannels);
  for (std::size_t i = 0; i < units.size(); i += kLightChannels)
    g.push_back(luminance(Rgbd{static_cast<double>(units[i]), static_cast<double>(units[i + 1]),
                               static_cast<double>(units[i + 2])}) /
                photons);
  return g;
}

struct Bakes {
  std::array<std::unique_ptr<Tallies>, 2> few, many;
  double fewPhotons, manyPhotons;
};

/// All maps by direction of flat sides, through every way.
void addSides(const BakePlan& plan, const Bakes& bakes, std::vector<Way>& ways) {
  for (const TallySide& side : plan.tallies.sides) {
    const MemberSet& members = plan.tallies.membersOf(side);
    const Chart& chart = plan.charts.charts[side.chart];
    if (members.members.empty() || chart.smooth) continue;
    const std::uint64_t first = plan.layout.charts[side.chart].firstTexel;
    const Grid area(plan.layout.area.begin() + static_cast<std::ptrdiff_t>(first),
                    plan.layout.area.begin() + static_cast<std::ptrdiff_t>(first + side.texelCount()));
    const Vec3d n = chart.normal * (side.back ? -1.0 : 1.0);
    for (std::uint64_t k = 0; k < members.members.size(); ++k) {
      const ClippedCell cell = plan.directions.clippedCell(members.members[k], n);
      const FineMap map{
          {side.width, side.height},
          {gridOf(*bakes.few[0], side, k, bakes.fewPhotons), gridOf(*bakes.few[1], side, k, bakes.fewPhotons)},
          {gridOf(*bakes.many[0], side, k, bakes.manyPhotons), gridOf(*bakes.many[1], side, k, bakes.manyPhotons)},
          area,
          cell.meanCosine(),
          cell.cosIntegral};
      for (Way& way : ways) addMap(map, way);
    }
  }
}

double percent(double squares, const Way::Sums& s) { return 100 * std::sqrt(std::max(0.0, squares) / s.power); }

/// The error of projected resolution with so many texels, between the ways that have fewer and more; 0: none has.
double projectedError(const std::vector<Way>& ways, std::uint64_t texels, Way::Sums Way::*sums) {
  const Way* below = nullptr;
  for (const Way& way : ways) {
    if (!way.projected) continue;
    if (below != nullptr && below->texels <= texels && texels < way.texels) {
      const auto log = [](std::uint64_t n) { return std::log(static_cast<double>(n)); };
      const double t = (log(texels) - log(below->texels)) / (log(way.texels) - log(below->texels));
      return percent((below->*sums).error, below->*sums) * (1 - t) + percent((way.*sums).error, way.*sums) * t;
    }
    below = &way;
  }
  return 0;
}

void report(const std::vector<Way>& ways) {
  std::printf("%-18s %9s | %8s %8s %8s | %10s %8s %8s\n", "way", "texels", "B: error", "noise", "bias", "B/C: error",
              "noise", "bias");
  for (const Way& w : ways) {
    std::printf("%-10s %7.3f %9llu", w.projected ? "projected" : "uniform", w.scale,
                static_cast<unsigned long long>(w.texels));
    for (const Way::Sums* s : {&w.light, &w.radiance})
      std::printf(" | %7.2f%% %7.2f%% %7.2f%%", percent(s->error, *s), percent(s->error - s->bias, *s),
                  percent(s->bias, *s));
    std::printf("\n");
  }
  for (const Way& w : ways)
    if (const double error = projectedError(ways, w.texels, &Way::light); !w.projected && error > 0)
      std::printf("projected with the texels of uniform %.1f: error %.2f%%, of B/C %.2f%%\n", w.scale, error,
                  projectedError(ways, w.texels, &Way::radiance));
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  CLI::App app("Uniform resolution of light maps, or by projected area.", "resolution_study");
  LayoutTexts texts;
  texts.directions = "32";
  std::uint64_t truth = 10;
  studies::Subject subject(app, texts);
  BakeOptions& options = subject.options;
  app.add_option("--truth", truth, "times the photons of a bake")->check(CLI::Range(1, 1000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  subject.load();
  PhotonScene photonScene(subject.packed.scene, {}, subject.sky.get());
  settleDirections(subject.packed.scene, options);
  prepareEmission(photonScene, options);
  options.texelsPerMetre *= kFine;
  options.texelBudget *= kFine * kFine;
  const BakePlan plan = makePlan(subject.packed.scene, options);
  const std::uint64_t few = options.photons, many = truth * few;
  Bakes bakes{{}, {}, static_cast<double>(few), static_cast<double>(many)};
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < 2; ++i)
    bakes.few[i] = countedIn(photonScene, plan, options, {begin, begin + few}), begin += few;
  for (std::size_t i = 0; i < 2; ++i)
    bakes.many[i] = countedIn(photonScene, plan, options, {begin, begin + many}), begin += many;
  std::vector<Way> ways;
  for (const double scale : {0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4}) ways.push_back({false, scale});
  for (const double scale : {0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.6, 1.8}) ways.push_back({true, scale});
  addSides(plan, bakes, ways);
  std::printf("%d directions, %.3g photons, texels of %.3g /m\n", options.directions, static_cast<double>(few),
              plan.layout.texelsPerMetre / kFine);
  report(ways);
  return 0;
}

}  // namespace
}  // namespace lucarne

int main(int argc, char** argv) {
  return lucarne::studies::runStudy("resolution_study", [&] { return lucarne::run(argc, argv); });
}
