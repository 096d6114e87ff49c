// How far may triangles lean away from their chart's plane?
//
//   chart_angle_study [--scene SCENE.glb] [--environment SKY] [--photons N] [--density D] [--angles 30,40,55,70]
//   [--truth K]
//
// Charts are grown with each angle (ChartOptions::maxAngleDegrees); TEXCOORD_1 is not used. What stands before the bar
// is of the density asked for; behind it, the density is changed until there are as many texels as with the default
// angle. That layout is baked twice, as `bake` does, and read at places spread evenly over the surface.
//
// The truth is that of two bakes with other seeds, K times the photons, each on texels kFine times as fine, bare
// histograms. With maps M1, M2 and truths T1, T2, (M1 − T1)(M1 − T2) is on average the squared error of a map and
// (M1 − T1)(M2 − T2) that part of it which is bias: the noise of the truths drops out. Their sums are over that of
// T1·T2, in per cent of the root.
//
// Stretch of a triangle is the longer over the shorter of the two ways a texel lies on it (1: square; the ratio of the
// singular values of the map from surface to texels): 1/cos of the angle to the chart's plane.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <random>

#include "dlm/atlas.h"
#include "tests/study/study.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {

constexpr int kFine = 3;
constexpr int kPlaces = 400'000;

struct Layout {
  ChartSet charts;
  TexelLayout texels;
};

Layout layOut(const Scene& scene, const BakeOptions& o, double angle) {
  ChartOptions options;
  options.maxAngleDegrees = angle;
  Layout l{growCharts(scene, options), {}};
  l.texels = layOutTexels(scene, l.charts, {o.texelsPerMetre, o.texelBudget, ~std::uint64_t{0}});
  return l;
}

BakePlan planOf(const Scene& scene, const BakeOptions& o, Layout layout) {
  DirectionSet directions(o.directions, o.directionFilter);
  TallyLayout tallies = planTallies(scene, layout.charts, layout.texels, directions, tallyWishes(o));
  return {std::move(layout.charts), std::move(layout.texels), std::move(directions), std::move(tallies)};
}

struct Place {
  std::uint32_t triangle;
  double b1, b2;  // barycentric
};

/// Evenly spread by area: one in each equal share of it.
std::vector<Place> placesOn(const Scene& scene) {
  std::vector<double> upTo;
  double area = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    upTo.push_back(area += isSkipped(scene, t) ? 0 : length(scene.scaledNormal(t)));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<Place> places;
  for (int i = 0; i < kPlaces; ++i) {
    const auto at = std::upper_bound(upTo.begin(), upTo.end(), area * (i + uniform(random)) / kPlaces);
    if (at == upTo.end()) continue;
    const double root = std::sqrt(uniform(random)), v = uniform(random);
    places.push_back({static_cast<std::uint32_t>(at - upTo.begin()), root * (1 - v), root * v});
  }
  return places;
}

/// The texel coordinates of a place.
Vec2d texelOf(const BakePlan& plan, const Place& p) {
  const auto& uv = plan.charts.cornerUv[p.triangle];
  const Vec2d scale = plan.layout.charts[plan.charts.chartOfTriangle[p.triangle]].texelsPerLocal;
  const auto at = [&p](float a, float b, float c) {
    return static_cast<double>(a) * (1 - p.b1 - p.b2) + static_cast<double>(b) * p.b1 + static_cast<double>(c) * p.b2;
  };
  return {at(uv[0].x, uv[1].x, uv[2].x) * scale.x, at(uv[0].y, uv[1].y, uv[2].y) * scale.y};
}

/// Luminance of irradiance there; bilinear, or of the texel alone.
double lux(const LightMaps& maps, const SideMaps& side, Vec2d st, bool bilinear) {
  if (!side.lit) return 0;
  const auto at = [&](double x, double y) {
    const int i = std::clamp(static_cast<int>(x), 0, side.width - 1),
              j = std::clamp(static_cast<int>(y), 0, side.height - 1);
    return static_cast<double>(
        luminance(maps.irradiance[side.firstTexel + static_cast<std::uint64_t>(j * side.width + i)]));
  };
  if (!bilinear) return at(st.x, st.y);
  const double x = std::clamp(st.x - 0.5, 0.0, side.width - 1.0), y = std::clamp(st.y - 0.5, 0.0, side.height - 1.0);
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  return (at(x, y) * (1 - fx) + at(x + 1, y) * fx) * (1 - fy) + (at(x, y + 1) * (1 - fx) + at(x + 1, y + 1) * fx) * fy;
}

/// At each place, of the front and of the back, where there is light to be stored.
std::vector<double> readings(const BakePlan& plan, const LightMaps& maps, const std::vector<Place>& places,
                             bool bilinear) {
  std::vector<double> all;
  all.reserve(2 * places.size());
  for (const Place& p : places) {
    const std::uint32_t chart = plan.charts.chartOfTriangle[p.triangle];
    for (const bool back : {false, true}) {
      const std::uint32_t side = chart == kNone ? kNone
                                 : back         ? maps.charts[chart].backSide
                                                : maps.charts[chart].frontSide;
      all.push_back(side == kNone ? 0 : lux(maps, maps.sides[side], texelOf(plan, p), bilinear));
    }
  }
  return all;
}

class AngleStudy {
 public:
  AngleStudy(const PhotonScene& scene, const BakeOptions& options, std::uint64_t truth)
      : scene_(scene), options_(options), places_(placesOn(scene.scene())) {
    standard_ = layOut(scene.scene(), options, ChartOptions{}.maxAngleDegrees).texels.texelCount;
    BakeOptions fine = options;
    fine.texelsPerMetre *= kFine;
    fine.texelBudget *= kFine * kFine;
    fine.photons *= truth;
    fine.kernel = {KernelShape::box, 0.5};
    fine.seams = SeamMode::keep;
    const BakePlan plan = planOf(scene.scene(), fine, layOut(scene.scene(), fine, ChartOptions{}.maxAngleDegrees));
    for (std::size_t i = 0; i < 2; ++i) {
      fine.seed = options.seed + 101 + i;
      truths_[i] = readings(plan, bake(plan, fine).maps, places_, false);
    }
  }

  void run(double angle) const {
    const Layout asked = layOut(scene_.scene(), options_, angle);
    const auto [mean, most] = stretchOf(asked);
    BakeOptions o = options_;
    Layout equal = asked;
    for (int i = 0; i < 4; ++i) {
      o.texelsPerMetre *= std::sqrt(static_cast<double>(standard_) / static_cast<double>(equal.texels.texelCount));
      equal = layOut(scene_.scene(), o, angle);
    }
    const std::uint64_t texels = equal.texels.texelCount;
    const BakePlan plan = planOf(scene_.scene(), o, std::move(equal));
    std::array<std::vector<double>, 2> maps;
    Baked baked;
    for (std::size_t i = 0; i < 2; ++i) {
      o.seed = options_.seed + i;
      baked = bake(plan, o);
      maps[i] = readings(plan, baked.maps, places_, true);
    }
    const Squares s = squaresOf(maps);
    const auto count = [](auto n) { return static_cast<unsigned long long>(n); };
    const auto percent = [&s](double squares) { return 100 * std::sqrt(std::max(0.0, squares) / s.power); };
    std::printf("%5.0f %8zu %9llu %7.3f %7.2f | %9llu %9llu %8.2f%% %8.2f%% %8.2f%% %8.2f%%\n", angle,
                asked.charts.charts.size(), count(asked.texels.texelCount), mean, most, count(texels),
                count(baked.maps.atlasWidth) * count(baked.maps.atlasHeight), percent(s.error), percent(s.bias),
                100 * baked.seams.jumpBefore, 100 * baked.seams.jumpAfter);
    std::fflush(stdout);
  }

 private:
  Baked bake(const BakePlan& plan, const BakeOptions& o) const {
    return bakeScene(scene_, plan, o, [](const RunProgress&) { return true; });
  }

  struct Squares {
    double error = 0, bias = 0, power = 0;
  };
  Squares squaresOf(const std::array<std::vector<double>, 2>& maps) const {
    Squares s;
    for (std::size_t i = 0; i < maps[0].size(); ++i) {
      const double t1 = truths_[0][i], t2 = truths_[1][i], m1 = maps[0][i], m2 = maps[1][i];
      s.error += ((m1 - t1) * (m1 - t2) + (m2 - t1) * (m2 - t2)) / 2;
      s.bias += ((m1 - t1) * (m2 - t2) + (m2 - t1) * (m1 - t2)) / 2;
      s.power += t1 * t2;
    }
    return s;
  }

  /// Mean by area, and largest.
  std::pair<double, double> stretchOf(const Layout& l) const {
    const Scene& scene = scene_.scene();
    double sum = 0, area = 0, most = 1;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const std::uint32_t chart = l.charts.chartOfTriangle[t];
      if (chart == kNone) continue;
      const Vec3d normal = scene.scaledNormal(t);
      const double cosine = dot(normalize(normal), l.charts.charts[chart].normal);
      const double stretch = 1 / std::max(1e-3, cosine);
      sum += length(normal) * stretch;
      area += length(normal);
      most = std::max(most, stretch);
    }
    return {sum / area, most};
  }

  const PhotonScene& scene_;
  BakeOptions options_;
  std::vector<Place> places_;
  std::uint64_t standard_ = 0;  // texels of the default angle
  std::array<std::vector<double>, 2> truths_;
};

int run(int argc, char** argv) {
  CLI::App app("Light maps by the largest angle between a triangle and its chart's plane.", "chart_angle_study");
  LayoutTexts texts;
  texts.directions = "1";
  std::uint64_t truth = 20;
  std::vector<double> angles = {30, 40, 55, 70};
  studies::Subject subject(app, texts);
  app.add_option("--angles", angles, "degrees")->delimiter(',')->check(CLI::Range(1.0, 80.0));
  app.add_option("--truth", truth, "times the photons of a bake")->check(CLI::Range(1, 1000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  subject.load();
  PhotonScene scene(subject.packed.scene, {}, subject.sky.get());
  settleDirections(subject.packed.scene, subject.options);
  prepareEmission(scene, subject.options);
  const AngleStudy study(scene, subject.options, truth);
  std::printf("%-5s %8s %9s %7s %7s | %9s %9s %9s %10s %9s\n", "angle", "charts", "texels", "stretch", "most",
              "as many", "atlas", "error", "jump", "fitted");
  for (const double angle : angles) study.run(angle);
  return 0;
}

}  // namespace
}  // namespace lucarne

int main(int argc, char** argv) {
  return lucarne::studies::runStudy("chart_angle_study", [&] { return lucarne::run(argc, argv); });
}
