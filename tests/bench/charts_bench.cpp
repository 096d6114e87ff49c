// Charts on ever finer meshes: time should grow as the triangles do.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "dlm/charts.h"

namespace lucarne {
namespace {

/// A bumpy ring, closed and curved everywhere.
Scene bumpyRing(std::int64_t triangles) {
  const auto across = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 8));
  const std::uint32_t around = 4 * across;
  Scene scene;
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const float a = kTurn * static_cast<float>(i) / static_cast<float>(around);
      const float b = kTurn * static_cast<float>(j) / static_cast<float>(across);
      const float r = 1 + 0.15f * std::sin(9 * a + 4 * b), ring = 3 + 0.3f * std::sin(5 * a) + r * std::cos(b);
      scene.positions.push_back({ring * std::cos(a), r * std::sin(b), ring * std::sin(a)});
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return (i % around) * across + j % across; };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      scene.triangles.push_back({{at(i, j), at(i, j + 1), at(i + 1, j)}, 0});
      scene.triangles.push_back({{at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}, 0});
    }
  }
  scene.materials.resize(1);
  scene.smooth.assign(scene.triangles.size(), 0);
  return scene;
}

void GrowCharts(benchmark::State& state) {
  const Scene scene = bumpyRing(state.range(0));
  std::size_t charts = 0;
  for (auto _ : state) charts = growCharts(scene).charts.size();
  state.counters["charts"] = static_cast<double>(charts);
  state.counters["triangles/s"] =
      benchmark::Counter(static_cast<double>(scene.triangles.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.SetComplexityN(static_cast<std::int64_t>(scene.triangles.size()));
}
BENCHMARK(GrowCharts)->RangeMultiplier(10)->Range(1'000, 1'000'000)->Unit(benchmark::kMillisecond)->Complexity();

}  // namespace
}  // namespace lucarne
