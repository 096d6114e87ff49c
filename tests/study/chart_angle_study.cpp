// How far may triangles lean away from their chart's plane?
//
//   chart_angle_study [--scene SCENE.glb] [--environment SKY] [--photons N] [--density D] [--angles 30,40,55,70]
//   [--truth K]
//
// Charts are grown with each angle (ChartOptions::maxAngleDegrees); TEXCOORD_1 is not used. First at the density asked
// for, then at one changed until there are as many texels as with the default angle, each layout is baked twice, as
// `bake` does, and read at places spread evenly over the surface. "jump" and "fitted": those at seams (seam_fit.h).
//
// The truth is a bake of another seed, K times the photons, on texels kFine times as fine, of charts of 20°: none of
// the angles has its own texels for a judge. Error of a reading m where the truth is t: (m − t) over their mean, at
// most 2 in size, so that hot spots and the dark do not decide; root mean square by area, in per cent. Places darker
// than a hundredth of the mean do not count.
//
// Stretch of a triangle is the longer over the shorter of the two ways a texel lies on it (1: square; the ratio of the
// singular values of the map from surface to texels): 1/cos of the angle to the chart's plane.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <numeric>
#include <random>

#include "tests/study/study.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {

constexpr int kFine = 3;
constexpr int kPlaces = 400'000;
constexpr double kDimmest = 0.01;   // of the mean: darker places do not count
constexpr double kTruthAngle = 20;  // degrees

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

/// Luminance of irradiance there, looked up bilinearly.
double lux(const LightMaps& maps, const SideMaps& side, Vec2d st) {
  if (!side.lit) return 0;
  const double x = std::clamp(st.x - 0.5, 0.0, side.width - 1.0), y = std::clamp(st.y - 0.5, 0.0, side.height - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const double fx = x - x0, fy = y - y0;
  const auto at = [&](int i, int j) {
    const int column = std::min(x0 + i, side.width - 1), row = std::min(y0 + j, side.height - 1);
    const auto texel = static_cast<std::uint64_t>(row * side.width + column);
    return static_cast<double>(luminance(maps.irradiance[side.firstTexel + texel]));
  };
  return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) + (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}

/// At each place, of the front and of the back; 0 where no light is stored.
std::vector<double> readings(const BakePlan& plan, const LightMaps& maps, const std::vector<Place>& places) {
  std::vector<double> all;
  all.reserve(2 * places.size());
  for (const Place& p : places) {
    const std::uint32_t chart = plan.charts.chartOfTriangle[p.triangle];
    for (const bool back : {false, true}) {
      std::uint32_t side = kNone;
      if (chart != kNone) side = back ? maps.charts[chart].backSide : maps.charts[chart].frontSide;
      all.push_back(side == kNone ? 0 : lux(maps, maps.sides[side], texelOf(plan, p)));
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
    fine.seed = options.seed + 101;
    const BakePlan plan = planOf(scene.scene(), fine, layOut(scene.scene(), fine, kTruthAngle));
    truth_ = readings(plan, bake(plan, fine).maps, places_);
    dimmest_ = kDimmest * std::accumulate(truth_.begin(), truth_.end(), 0.0) / static_cast<double>(truth_.size());
  }

  void run(double angle) const {
    BakeOptions o = options_;
    Layout layout = layOut(scene_.scene(), o, angle);
    const auto [mean, most] = stretchOf(layout);
    const auto count = [](auto n) { return static_cast<unsigned long long>(n); };
    std::printf("%5.0f %8zu %7.3f %7.2f", angle, layout.charts.charts.size(), mean, most);
    for (const bool equal : {false, true}) {
      for (int i = 0; equal && i < 4; ++i) {
        o.texelsPerMetre *= std::sqrt(static_cast<double>(standard_) / static_cast<double>(layout.texels.texelCount));
        layout = layOut(scene_.scene(), o, angle);
      }
      const std::uint64_t texels = layout.texels.texelCount;
      const Judged j = judge(planOf(scene_.scene(), o, layout), o);
      std::printf(" | %9llu %9llu %7.2f%% %7.2f%% %7.2f%%", count(texels), count(j.atlas), 100 * j.error,
                  100 * j.seams.jumpBefore, 100 * j.seams.jumpAfter);
    }
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  Baked bake(const BakePlan& plan, const BakeOptions& o) const {
    return bakeScene(scene_, plan, o, [](const RunProgress&) { return true; });
  }

  struct Judged {
    double error = 0;
    std::uint64_t atlas = 0;  // texels of its pages
    SeamReport seams;
  };
  Judged judge(const BakePlan& plan, BakeOptions o) const {
    Judged j;
    double square = 0;
    for (std::uint64_t i = 0; i < 2; ++i) {
      o.seed = options_.seed + i;
      const Baked baked = bake(plan, o);
      square += errorOf(readings(plan, baked.maps, places_)) / 2;
      j.atlas = static_cast<std::uint64_t>(baked.maps.atlasWidth) * static_cast<std::uint64_t>(baked.maps.atlasHeight);
      j.seams = baked.seams;
    }
    j.error = std::sqrt(square);
    return j;
  }

  /// Mean square.
  double errorOf(const std::vector<double>& map) const {
    double sum = 0, counted = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      if (!(truth_[i] > dimmest_)) continue;
      const double off = 2 * (map[i] - truth_[i]) / (map[i] + truth_[i]);
      sum += off * off;
      ++counted;
    }
    return sum / std::max(1.0, counted);
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
  std::vector<double> truth_;
  double dimmest_ = 0;  // lux
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
  std::printf("%-5s %8s %7s %7s", "angle", "charts", "stretch", "most");
  for (const char* texels : {"texels", "as many"})
    std::printf(" | %9s %9s %8s %8s %8s", texels, "atlas", "error", "jump", "fitted");
  std::printf("\n");
  for (const double angle : angles) study.run(angle);
  return 0;
}

}  // namespace
}  // namespace lucarne

int main(int argc, char** argv) {
  return lucarne::studies::runStudy("chart_angle_study", [&] { return lucarne::run(argc, argv); });
}
