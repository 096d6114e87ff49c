// Measures rays per second: bare, traced, and counted in light maps, on one and on two threads.
//
//   bench_rays [--json] [--seconds N] [--scene NAME|FILE.glb]... [--smooth]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json.h"
#include "base/system.h"
#include "distributed/build_info.h"
#include "tests/bench/bench_measure.h"
#include "tests/bench/bench_scenes.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne::bench {
namespace {

using nlohmann::json;

struct Arguments {
  bool json = false, smooth = false;
  double seconds = 45;
  std::vector<std::string> scenes;
};

/// UsageError for a name that is neither a recipe's nor a file's.
Scene sceneOf(const std::string& name, bool smooth) {
  std::string known;
  for (const SceneRecipe& recipe : sceneRecipes()) {
    if (recipe.name == name) return recipe.make(smooth);
    known += recipe.name + ", ";
  }
  if (name.ends_with(".glb") || name.ends_with(".gltf")) return readGltf(name);
  throw UsageError("no scene '" + name + "'; there are " + known + "or name a .glb or .gltf file");
}

std::vector<SceneResult> measureAll(const Arguments& arguments) {
  std::vector<std::string> names = arguments.scenes;
  if (names.empty())
    for (const SceneRecipe& recipe : sceneRecipes()) names.push_back(recipe.name);
  std::vector<Scene> scenes;  // all before the first is measured: a wrong name shows at once
  for (const std::string& name : names) scenes.push_back(sceneOf(name, arguments.smooth));
  std::vector<MemoryUse> memory;  // before there are threads
  for (const Scene& scene : scenes) memory.push_back(measureMemory(scene));
  std::vector<SceneResult> results;
  for (std::size_t i = 0; i < names.size(); ++i) {
    results.push_back(measure(names[i], scenes[i], arguments.seconds / static_cast<double>(names.size())));
    results.back().memory = memory[i];
  }
  return results;
}

json quartiles(const Spread& s) { return {s.low, s.high}; }

json toJson(const SceneResult& r) {
  return {{"name", r.name},
          {"triangles", r.triangles},
          {"texels", r.texels},
          {"scene_bytes", r.sceneBytes},
          {"embree_bytes", r.embreeBytes},
          {"tally_bytes", r.tallyBytes},
          {"large_tally_bytes", r.largeTallyBytes},
          {"peak_bytes", r.memory.peak},
          {"held_bytes", r.memory.held},
          {"memory_over_embree_and_tallies", r.memory.peakOver()},
          {"held_over_embree_and_tallies", r.memory.heldOver()},
          {"two_threads_share_tallies", r.sharedTallies},
          {"rounds", r.rounds},
          {"raw_rays_per_photon", r.rawRaysPerPhoton},
          {"rays_per_photon", r.raysPerPhoton},
          {"raw_rays_per_second", r.rawRaysPerSecond.median},
          {"trace_rays_per_second", r.traceRaysPerSecond.median},
          {"deposit_rays_per_second", r.depositRaysPerSecond.median},
          {"trace_over_raw", r.traceOverRaw.median},
          {"trace_over_raw_quartiles", quartiles(r.traceOverRaw)},
          {"with_deposit_over_raw", r.depositOverRaw.median},
          {"with_deposit_over_raw_quartiles", quartiles(r.depositOverRaw)},
          {"with_large_deposit_over_raw", r.largeOverRaw.median},
          {"with_large_deposit_over_raw_quartiles", quartiles(r.largeOverRaw)},
          {"two_threads_over_one", r.twoThreadsOverOne.median},
          {"two_threads_over_one_quartiles", quartiles(r.twoThreadsOverOne)}};
}

void printJson(const std::vector<SceneResult>& results, const Arguments& arguments) {
  const HostDescription host = describeHost();
  json scenes = json::array();
  for (const SceneResult& r : results) scenes.push_back(toJson(r));
  const json all{
      {"machine", {{"cpu", host.cpu}, {"cores", host.threads}, {"system", host.system}}},
      {"versions", {{"lucarne", buildName()}, {"embree", results.front().rayCaster}, {"compiler", __VERSION__}}},
      {"smooth_normals", arguments.smooth},
      {"scenes", scenes}};
  std::fputs(dumpJson(all).c_str(), stdout);
}

void printTable(const std::vector<SceneResult>& results) {
  std::printf("%s\n%s\nRates: million rays per second of CPU time. Ratios: medians, in brackets their quartiles.\n\n",
              describeHost().cpu.c_str(), buildName().c_str());
  std::printf("%-12s %9s %7s %6s  %-18s  %-18s  %-18s  %-18s  %s\n", "scene", "triangles", "tallies", "raw",
              "trace/raw", "with deposit/raw", "large deposit/raw", "2 threads/1",
              "memory/(Embree + tallies), peak, held");
  const auto print = [](const Spread& s) { std::printf("  %.3f (%.3f-%.3f)", s.median, s.low, s.high); };
  for (const SceneResult& r : results) {
    std::printf("%-12s %9llu %4.0f MB %6.2f", r.name.c_str(), static_cast<unsigned long long>(r.triangles),
                1e-6 * static_cast<double>(r.tallyBytes), 1e-6 * r.rawRaysPerSecond.median);
    for (const Spread& s : {r.traceOverRaw, r.depositOverRaw, r.largeOverRaw, r.twoThreadsOverOne}) print(s);
    std::printf("  %.2f %.2f\n", r.memory.peakOver(), r.memory.heldOver());
  }
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Rays per second: bare, traced, counted in light maps, on one and two threads.", "bench_rays");
  app.add_flag("--json", arguments.json, "print JSON instead of a table");
  app.add_flag("--smooth", arguments.smooth, "interpolate the vertex normals of curved surfaces of made scenes");
  app.add_option("--seconds", arguments.seconds, "time of measuring, all scenes together")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 3600.0));
  app.add_option("--scene", arguments.scenes,
                 "room, room_250k, hall_1m or a .glb or .gltf file; all three if left out");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
  const std::vector<SceneResult> results = measureAll(arguments);
  if (arguments.json)
    printJson(results, arguments);
  else
    printTable(results);
  return 0;
}

}  // namespace
}  // namespace lucarne::bench

int main(int argc, char** argv) {
  try {
    return lucarne::bench::run(argc, argv);
  } catch (const lucarne::Error& e) {
    std::fprintf(stderr, "bench_rays: %s\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_rays: %s\n", e.what());
    return 1;
  }
}
