// What the mean direction of the light in each cell of Ω is worth to highlights.
//
//   moment_study [--scene SCENE.glb] [--photons N] [--density D] [--patches P]
//
// Photons are counted on patches (texels of a coarse layout) once by cell alone and once by cell with Σ β·wi. The
// mirrored radiance of both, seen from many sides, is compared with that of the photons themselves, each with its own
// direction: of the same photons (what the cells alone do wrong) and of four times as many others (noise included).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <numeric>

#include "base/error.h"
#include "base/units.h"
#include "dlm/deposit.h"
#include "dlm/lobe_width.h"
#include "player/cell_tables.h"
#include "tests/study/study.h"
#include "tracer/optics/phong.h"
#include "tracer/transport/any_sink.h"

namespace lucarne {
namespace {

constexpr int kViews = 24, kQuadrature = 8192;
constexpr std::array kSizes = {14, 32, 64, 128, 256, 1024};
constexpr std::array kExponents = {1.f, 3.f, 10.f, 30.f, 100.f, 300.f};
constexpr std::array kBounds = {2.0, 4.0, 8.0, 1e9};  // how many times as sharp as a cell light is taken to be

struct Sample {
  std::uint64_t texel;
  float light;
  Vec3f wi, n;
};

struct PatchSink {
  const TexelMap& map;
  std::vector<Sample>& samples;
  void hit(const PhotonHit& h) {
    const TexelMap::Entry& entry = map[h.hit.triangle];
    const std::uint32_t index = h.hit.back ? entry.back : entry.front;
    if (index == kNone) return;
    const TexelMap::Side& side = map.side(index);
    const Vec2f st = entry.st0 + entry.e1 * h.hit.b.x + entry.e2 * h.hit.b.y;
    const int x = std::clamp(static_cast<int>(st.x), 0, side.width - 1);
    const int y = std::clamp(static_cast<int>(st.y), 0, side.height - 1);
    samples.push_back({side.firstTexel + static_cast<std::uint64_t>(y * side.width + x), luminance(h.beta), h.wi, h.n});
  }
  void endPhoton() {}
};

std::vector<Sample> samplesOf(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& o, IndexRange range) {
  const TexelMap map(scene.scene(), plan.charts, plan.layout, plan.tallies);
  std::vector<Sample> samples;
  PatchSink sink{map, samples};
  Ledger ledger;
  flyPhotons(scene, range, runOptions(o).seed, {}, sink, ledger);
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.texel < b.texel; });
  return samples;
}

double gaussian(double sharpness, double cosine) { return std::exp(sharpness * (cosine - 1)); }

/// Evenly spread directions, for integrals over the hemisphere and for views.
std::vector<Vec3d> spiral(int count) {
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, phi = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    points.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  return points;
}

struct Cell {
  double light = 0;
  Vec3d moment{};
};

struct Patch {
  std::span<const Sample> seen, truth;
  double truthScale;  // of the truth's light
  Vec3d n;
};

/// Squared errors of the ways, and the truth squared.
struct Errors {
  double cell = 0, own = 0, power = 0;          // own: the photons themselves, against the truth
  std::array<double, kBounds.size()> moment{};  // by bound
};

double direct(std::span<const Sample> samples, double sharpness, Vec3d r) {
  double sum = 0;
  for (const Sample& s : samples) sum += static_cast<double>(s.light) * gaussian(sharpness, dot(Vec3d(s.wi), r));
  return sum;
}

double constantLight(const std::vector<Vec3d>& points, Vec3d n, double sharpness, Vec3d r) {
  double sum = 0;
  for (const Vec3d& p : points)
    if (dot(p, n) > 0) sum += dot(p, n) * gaussian(sharpness, dot(p, r));
  return sum * 4 * std::numbers::pi / static_cast<double>(points.size());
}

struct CellSum {
  double value, constant;
};

/// g of lobe.h.
double meanDensity(Vec3d mean, double lobe, double bounded, double bound, Vec3d r) {
  const double length = std::clamp(std::sqrt(dot(mean, mean)), 1e-4, 1.0);
  const double spread = (1 - length * length) / (length * (3 - length * length));
  const double sharpness = lobe / (1 + lobe * (1 / (bound * bounded) + (1 - 1 / bound) * spread));
  return sharpness / (1 - std::exp(-2 * sharpness)) * gaussian(sharpness, dot(mean, r) / length);
}

void compare(const Patch& patch, const DirectionSet& set, double exponent, bool sameTruth,
             const std::vector<Vec3d>& points, Errors& errors) {
  std::vector<Cell> cells(static_cast<std::size_t>(set.count()));
  for (const Sample& s : patch.seen) {
    Cell& c = cells[static_cast<std::size_t>(set.nearest(s.wi))];
    c.light += static_cast<double>(s.light);
    c.moment += Vec3d(s.wi) * static_cast<double>(s.light);
  }
  const double lobe = exponent + 1, wide = static_cast<double>(cellSharpness(set.count()));
  const double shown = lobe * wide / (lobe + wide);
  std::vector<LobeCell> shape;
  std::vector<MeanCell> means;
  for (int psi = 0; psi < set.count(); ++psi) {
    shape.push_back(lobeCell(set, psi, patch.n));
    means.push_back(meanCell(set, psi, patch.n));
  }
  const std::vector<Vec3d> views = spiral(2 * kViews);
  for (const Vec3d& r : views) {
    if (dot(r, patch.n) < 0.1) continue;
    const double scale = 1 / constantLight(points, patch.n, lobe, r);
    const double own = direct(patch.seen, lobe, r) * scale;
    const double truth = sameTruth ? own : direct(patch.truth, lobe, r) * scale * patch.truthScale;
    double byCell = 0, constant = 0;
    std::array<double, kBounds.size()> light{}, even{};
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const double w = gaussian(shown, dot(Vec3d(shape[k].direction), r));
      byCell += cells[k].light * w;
      constant += static_cast<double>(shape[k].cosIntegral) * w;
      for (std::size_t b = 0; b < kBounds.size(); ++b) {
        even[b] += static_cast<double>(means[k].cosIntegral) *
                   meanDensity(Vec3d(means[k].direction), lobe, wide, kBounds[b], r);
        if (cells[k].light > 0)
          light[b] += cells[k].light * meanDensity(cells[k].moment / cells[k].light, lobe, wide, kBounds[b], r);
      }
    }
    const auto square = [](double v) { return v * v; };
    errors.cell += square(byCell / constant - truth);
    for (std::size_t b = 0; b < kBounds.size(); ++b) errors.moment[b] += square(light[b] / even[b] - truth);
    errors.own += square(own - truth);
    errors.power += square(truth);
  }
}

std::span<const Sample> ofTexel(const std::vector<Sample>& samples, std::uint64_t texel) {
  const auto range = std::equal_range(samples.begin(), samples.end(), Sample{texel, 0, {}, {}},
                                      [](const Sample& a, const Sample& b) { return a.texel < b.texel; });
  return {range.first, range.second};
}

std::vector<Patch> choosePatches(const std::vector<Sample>& seen, const std::vector<Sample>& truth, std::size_t most,
                                 double truthScale) {
  constexpr std::size_t kLeast = 30;
  std::vector<Patch> all;
  for (std::size_t i = 0; i < seen.size();) {
    const std::span<const Sample> own = ofTexel(seen, seen[i].texel);
    if (own.size() >= kLeast)
      all.push_back({own, ofTexel(truth, seen[i].texel), truthScale, normalize(Vec3d(own[0].n))});
    i += own.size();
  }
  std::vector<Patch> chosen;
  for (std::size_t i = 0; i < most && !all.empty(); ++i) chosen.push_back(all[i * all.size() / most]);
  return chosen;
}

int run(int argc, char** argv) {
  CLI::App app("What mean directions are worth to highlights.", "moment_study");
  std::size_t patches = 200;
  studies::Subject subject(app);
  BakeOptions& options = subject.options;
  app.add_option("--patches", patches)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  subject.load();
  const PhotonScene photonScene(subject.packed.scene, {}, subject.sky.get());
  const BakePlan plan = makePlan(subject.packed.scene, options);
  constexpr std::uint64_t kMore = 4;
  const auto seen = samplesOf(photonScene, plan, options, {0, options.photons});
  const auto truth = samplesOf(photonScene, plan, options, {options.photons, (1 + kMore) * options.photons});
  const std::vector<Patch> chosen = choosePatches(seen, truth, patches, 1.0 / kMore);
  double photons = 0;
  for (const Patch& p : chosen) photons += static_cast<double>(p.seen.size());
  std::printf("%zu patches of %.0f photons each; means bounded to 2, 4, 8 cells' sharpness, and not bounded\n",
              chosen.size(), photons / static_cast<double>(chosen.size()));
  std::printf("%8s %6s | %10s %9s %9s %9s %9s | %9s %9s %9s %9s %9s %9s\n", "exponent", "cells", "same: cell", "2", "4",
              "8", "none", "new: cell", "2", "4", "8", "none", "photons");
  const std::vector<Vec3d> points = spiral(kQuadrature);
  for (const float exponent : kExponents) {
    for (const int size : kSizes) {
      const DirectionSet set(size);
      Errors same, other;
      for (const Patch& p : chosen) {
        compare(p, set, static_cast<double>(exponent), true, points, same);
        compare(p, set, static_cast<double>(exponent), false, points, other);
      }
      const auto percent = [](double error, const Errors& e) { return 100 * std::sqrt(error / e.power); };
      const auto row = [&](const Errors& e) {
        std::printf(" | %9.1f%%", percent(e.cell, e));
        for (const double m : e.moment) std::printf(" %8.1f%%", percent(m, e));
      };
      std::printf("%8.0f %6d", static_cast<double>(exponent), size);
      row(same);
      row(other);
      std::printf(" %8.1f%%\n", percent(other.own, other));
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace
}  // namespace lucarne

int main(int argc, char** argv) {
  return lucarne::studies::runStudy("moment_study", [&] { return lucarne::run(argc, argv); });
}
