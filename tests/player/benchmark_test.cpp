#include "player/benchmark.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lucarne::benchmark_test {
namespace {

TEST(Benchmark, PercentilesAreValuesThatSoManyDoNotExceed) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Spread s = spreadOf(values);
  EXPECT_EQ(s.mean, 100.5);
  EXPECT_EQ(s.p50, 100);
  EXPECT_EQ(s.p90, 180);
  EXPECT_EQ(s.p99, 198);
  EXPECT_EQ(s.max, 200);
  const Spread one = spreadOf({3});
  EXPECT_EQ(one.p50, 3);
  EXPECT_EQ(one.p99, 3);
  EXPECT_EQ(spreadOf({}).max, 0);
}

TEST(Benchmark, TellsTimesInMillisecondsAndNoGpuTimeThatIsNotTrue) {
  Benchmark b;
  b.frameSeconds = {0.01, 0.02, 0.03};
  b.stats.counts.draws = 7;
  auto json = nlohmann::json::parse(textOf(b));
  EXPECT_DOUBLE_EQ(json["frame_ms"]["p50"], 20);
  EXPECT_DOUBLE_EQ(json["fps"], 50);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["sorted"]["draws"], 7);
  EXPECT_TRUE(json["gpu_ms"].is_null());
  EXPECT_FALSE(json.contains("shown_seconds")) << "no window was waited for";
  EXPECT_GT(json["peak_memory_bytes"], 0);
  b.gpuSeconds = {0.002};
  json = nlohmann::json::parse(textOf(b));
  EXPECT_DOUBLE_EQ(json["gpu_ms"]["max"], 2);
  b.shownSeconds = 1.5;
  b.loadingSeconds = {0.016, 0.2};
  json = nlohmann::json::parse(textOf(b));
  EXPECT_DOUBLE_EQ(json["shown_seconds"], 1.5);
  EXPECT_DOUBLE_EQ(json["loading_frame_ms"]["max"], 200);
  b.frameSeconds.clear();
  EXPECT_EQ(nlohmann::json::parse(textOf(b))["fps"], 0);
}

}  // namespace
}  // namespace lucarne::benchmark_test
