// How much noise a way of tracing leaves in light maps, for the time that it takes.
//
//   noise_study [SCENE.glb] [--environment SKY] [--density D] [--photons N] [--seeds S] WAY...
//
// A WAY is options of `bake` in one word, joined by '+': random, sobol, plain (no guide), guided. Each is baked S times
// with seeds of its own, on one thread, ways in turn. The variance of each texel over the seeds needs no reference.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>

#include "base/error.h"
#include "base/units.h"
#include "tests/study/study.h"

namespace lucarne {
namespace {

struct Way {
  std::string name;
  BakeOptions options;
  double seconds = 0;                   // CPU, all seeds, pilots included
  std::vector<std::vector<float>> lux;  // [seed][texel]
};

Way wayFrom(const std::string& name, BakeOptions options) {
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('+', at), name.size());
    const std::string word = name.substr(at, end - at);
    if (word == "random" || word == "sobol")
      options.sampler = word == "sobol" ? SamplerKind::sobol : SamplerKind::random;
    else if (word == "plain" || word == "guided")
      options.guidedEmission = word == "guided";
    else
      throw UsageError("'" + word + "' is none of random, sobol, plain, guided");
    at = end + 1;
  }
  return {name, options, 0, {}};
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Irradiance of all texels of all sides, zeros on dark ones.
std::vector<float> texelsOf(const BakePlan& plan, const LightMaps& maps) {
  std::vector<float> lux(plan.tallies.texels, 0.f);
  for (std::size_t s = 0; s < maps.sides.size(); ++s) {
    if (!maps.sides[s].lit) continue;
    for (std::uint64_t t = 0; t < maps.sides[s].texelCount(); ++t)
      lux[plan.tallies.sides[s].firstTexel + t] = luminance(maps.irradiance[maps.sides[s].firstTexel + t]);
  }
  return lux;
}

void bakeOnce(Way& way, const PackedScene& packed, const Environment* sky, std::uint64_t seed) {
  BakeOptions o = way.options;
  o.seed = seed;
  PhotonScene scene(packed.scene, {}, sky);
  const BakePlan plan = makePlan(packed.scene, o);
  const double start = cpuSeconds();
  prepareEmission(scene, o);
  const Baked baked = bakeScene(scene, plan, o, [](const RunProgress&) { return true; });
  way.seconds += cpuSeconds() - start;
  way.lux.push_back(texelsOf(plan, baked.maps));
}

struct Noise {
  double bright = 0;   // RMS error over RMS value, weighted by area: what the brightest texels have
  double typical = 0;  // root of the mean of squared relative errors of texels
};

Noise noiseOf(const Way& way, const std::vector<double>& area, const std::vector<double>& mean) {
  double variance = 0, power = 0, relative = 0, covered = 0, light = 0, all = 0;
  for (std::size_t t = 0; t < mean.size(); ++t) {
    light += area[t] * mean[t];
    all += area[t];
  }
  const auto n = static_cast<double>(way.lux.size());
  for (std::size_t t = 0; t < mean.size(); ++t) {
    double sum = 0, squares = 0;
    for (const auto& lux : way.lux) {
      const auto v = static_cast<double>(lux[t]);
      sum += v;
      squares += v * v;
    }
    const double v = std::max(0.0, (squares - sum * sum / n) / (n - 1));
    variance += area[t] * v;
    power += area[t] * mean[t] * mean[t];
    constexpr double kDimmest = 1e-3;  // of the mean: darker ones do not show
    if (!(mean[t] > kDimmest * light / all)) continue;
    relative += area[t] * v / (mean[t] * mean[t]);
    covered += area[t];
  }
  return {std::sqrt(variance / power), std::sqrt(relative / covered)};
}

void report(const std::vector<Way>& ways, const BakePlan& plan) {
  std::vector<double> mean(plan.tallies.texels, 0), area(plan.tallies.texels, 0);
  double bakes = 0;
  for (const Way& way : ways)
    for (const auto& lux : way.lux) {
      ++bakes;
      for (std::size_t t = 0; t < mean.size(); ++t) mean[t] += static_cast<double>(lux[t]);
    }
  for (double& m : mean) m /= bakes;
  for (const TallySide& side : plan.tallies.sides)
    for (std::uint64_t t = 0; t < side.texelCount(); ++t)
      area[side.firstTexel + t] = plan.layout.area[plan.layout.charts[side.chart].firstTexel + t];
  std::printf("%-16s %10s %10s %10s %22s\n", "way", "CPU s", "bright", "typical", "worth at equal time");
  const Noise first = noiseOf(ways[0], area, mean);
  for (const Way& way : ways) {
    const Noise n = noiseOf(way, area, mean);
    const auto worth = [&](double own, double reference) {
      return reference * reference * ways[0].seconds / (own * own * way.seconds);
    };
    std::printf("%-16s %10.2f %9.2f%% %9.2f%% %10.2fx %9.2fx\n", way.name.c_str(),
                way.seconds / static_cast<double>(way.lux.size()), 100 * n.bright, 100 * n.typical,
                worth(n.bright, first.bright), worth(n.typical, first.typical));
  }
}

int run(int argc, char** argv) {
  CLI::App app("Noise of light maps for the time they take, by ways of tracing.", "noise_study");
  std::vector<std::string> names;
  std::uint64_t seeds = 5;
  studies::Subject subject(app);
  BakeOptions& options = subject.options;
  app.add_option("--seeds", seeds, "bakes of each way")->check(CLI::Range(2, 1000))->capture_default_str();
  app.add_option("WAY", names, "random, sobol, plain, guided, joined by +")->required();
  CLI11_PARSE(app, argc, argv);
  subject.load();
  options.threads = 1;
  std::vector<Way> ways;
  for (const std::string& name : names) ways.push_back(wayFrom(name, options));
  for (std::uint64_t s = 0; s < seeds; ++s)
    for (Way& way : ways) bakeOnce(way, subject.packed, subject.sky.get(), 100 + s);
  report(ways, makePlan(subject.packed.scene, options));
  return 0;
}

}  // namespace
}  // namespace lucarne

int main(int argc, char** argv) {
  return lucarne::studies::runStudy("noise_study", [&] { return lucarne::run(argc, argv); });
}
