#include "player/benchmark.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/json.h"
#include "base/memory.h"

namespace lucarne {
namespace {

nlohmann::json jsonOf(const Spread& s) {
  return {
      {"mean", 1e3 * s.mean}, {"p50", 1e3 * s.p50}, {"p90", 1e3 * s.p90}, {"p99", 1e3 * s.p99}, {"max", 1e3 * s.max}};
}

nlohmann::json jsonOf(const StateCounts& c) {
  return {{"draws", c.draws},
          {"direction_switches", c.directionSwitches},
          {"material_switches", c.materialSwitches},
          {"texture_switches", c.textureSwitches}};
}

const char* nameOf(RendererKind kind) { return kind == RendererKind::multipass ? "multipass" : "singlepass"; }

const char* nameOf(LightMapFormat format) {
  return format == LightMapFormat::half ? "half" : format == LightMapFormat::rgb9e5 ? "rgb9e5" : "float";
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(std::max(std::ceil(share * n), 1.0)) - 1];
  };
  return {std::accumulate(values.begin(), values.end(), 0.0) / n, at(0.5), at(0.9), at(0.99), values.back()};
}

std::string textOf(const Benchmark& b) {
  const Spread frame = spreadOf(b.frameSeconds);
  nlohmann::json json;
  json["driver"] = b.stats.driver;
  json["renderer"] = nameOf(b.options.renderer);
  json["map_format"] = nameOf(b.options.format);
  json["directions"] = b.stats.directions;
  json["width"] = b.width;
  json["height"] = b.height;
  json["path_fps"] = b.pathFps;
  json["frames"] = b.frameSeconds.size();
  json["fps"] = frame.mean > 0 ? 1 / frame.mean : 0.0;
  json["frame_ms"] = jsonOf(frame);
  json["gpu_ms"] = b.gpuSeconds.empty() ? nlohmann::json() : jsonOf(spreadOf(b.gpuSeconds));
  json["sorted"] = jsonOf(b.stats.counts);
  json["unsorted"] = jsonOf(b.stats.unsorted);
  json["load_seconds"] = b.loadSeconds;
  if (!b.loadingSeconds.empty()) {
    json["shown_seconds"] = b.shownSeconds;
    json["loading_frame_ms"] = jsonOf(spreadOf(b.loadingSeconds));
  }
  json["peak_memory_bytes"] = peakMemoryBytes();
  json["gl_bytes"] = b.glBytes;
  json["light_map_bytes"] = b.stats.lightMapBytes;
  return dumpJson(json);
}

}  // namespace lucarne
