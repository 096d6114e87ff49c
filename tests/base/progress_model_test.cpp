// After the first tenth of a run the time left is right within a fifth, on machines of many moods.
#include "base/progress_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace lucarne::progress_model_test {
namespace {

constexpr double kStep = 0.25;  // seconds between updates

/// A machine: photons a second at a moment, and pauses for saving.
struct Machine {
  std::function<double(double seconds)> rate;
  double pauseEvery = 1e18, pause = 0;  // seconds
};

struct Moment {
  double now, left;
  std::optional<double> told;
};

/// Every update of a run to its goal, with the time that really was left.
std::vector<Moment> run(const Machine& machine, std::uint64_t photons, double start = 1000) {
  ProgressModel model({photons, {}, 0}, start);
  std::vector<Moment> moments;
  double now = start, done = 0, nextPause = machine.pauseEvery;
  while (done < static_cast<double>(photons)) {
    done = std::min(static_cast<double>(photons), done + machine.rate(now - start) * kStep);
    now += kStep;
    if (now - start > nextPause) {
      now += machine.pause;
      nextPause += machine.pauseEvery;
    }
    model.update(now, static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(3 * done));
    moments.push_back({now, 0, model.secondsLeft(now)});
  }
  for (Moment& m : moments) m.left = now - m.now;
  return moments;
}

/// The largest error, relative to what is left and forgiving a second, after the first tenth.
double worst(const std::vector<Moment>& moments, double start = 1000) {
  const double end = moments.back().now - start;
  double worst = 0;
  for (const Moment& m : moments) {
    if (m.now - start < 0.1 * end || m.left < 1) continue;
    EXPECT_TRUE(m.told.has_value());
    worst = std::max(worst, std::max(0.0, std::abs(m.told.value_or(1e9) - m.left) - 1) / m.left);
  }
  return worst;
}

TEST(ProgressModel, TimeLeftIsRightOnASteadyMachine) {
  EXPECT_LT(worst(run({[](double) { return 1e6; }}, 20'000'000)), 0.01);
  EXPECT_LT(worst(run({[](double) { return 1e6; }}, 30'000'000'000)), 0.01);
}

TEST(ProgressModel, TimeLeftIsRightWithinAFifth) {
  const auto coldStart = [](double t) { return 1e6 * (1 - 0.5 * std::exp(-t / 2)); };
  const auto warming = [](double t) { return 1e6 * (0.88 + 0.12 * std::exp(-t / 300)); };
  const auto waves = [](double t) { return 1e6 * (1 + 0.3 * std::sin(t / 2)); };
  const auto slowWaves = [](double t) { return 1e6 * (1 + 0.1 * std::sin(t / 600)); };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> factor(0.4, 1.6);
  const auto noisy = [&](double) { return 1e6 * factor(random); };
  EXPECT_LT(worst(run({coldStart}, 60'000'000)), 0.2);
  EXPECT_LT(worst(run({warming}, 3'000'000'000)), 0.2);
  EXPECT_LT(worst(run({waves}, 300'000'000)), 0.2);
  EXPECT_LT(worst(run({slowWaves}, 10'000'000'000)), 0.2);
  EXPECT_LT(worst(run({noisy}, 100'000'000)), 0.2);
  EXPECT_LT(worst(run({noisy, 300, 6}, 10'000'000'000)), 0.2) << "pauses for saving";
  EXPECT_LT(worst(run({waves, 60, 1.2}, 1'000'000'000)), 0.2);
}

TEST(ProgressModel, AnInterludeIsNoneOfTheRate) {
  ProgressModel model({10'000'000, {}, 0}, 0);
  model.update(1, 1'000'000, 0);
  model.paused(1.5, 9.5);
  model.update(10, 2'000'000, 0);  // 1 s of tracing since the last
  EXPECT_NEAR(model.photonRate(), 1e6, 1);
  EXPECT_NEAR(model.secondsLeft(10).value(), 8, 1e-6);
  EXPECT_NEAR(model.meanPhotonRate(10), 1e6, 1);
  EXPECT_NEAR(model.seconds(10), 10, 1e-12) << "but of the time that was spent";
  model.paused(9, 9.5);  // known already
  model.update(11, 3'000'000, 0);
  EXPECT_NEAR(model.photonRate(), 1e6, 1);
}

TEST(ProgressModel, AMachineThatSlowsDownIsFollowed) {
  const auto moments = run({[](double t) { return t < 200 ? 1e6 : 5e5; }}, 400'000'000);
  double worstLater = 0;
  for (const Moment& m : moments)
    if (m.now - 1000 > 400 && m.left > 5) worstLater = std::max(worstLater, std::abs(*m.told - m.left) / m.left);
  EXPECT_LT(worstLater, 0.2);
}

TEST(ProgressModel, WhateverComesFirstIsWhatIsLeft) {
  ProgressModel model({1'000'000, 50.0, 0.01}, 0);
  model.update(10, 100'000, 0);
  EXPECT_NEAR(model.secondsLeft(10).value(), 40, 1e-9) << "the time, before the 90 s of photons";
  EXPECT_NEAR(model.fraction(10).value(), 0.2, 1e-9);
  model.estimated(0.012, 100'000);  // 144,000 photons give 1 %
  EXPECT_NEAR(model.secondsLeft(10).value(), 4.4, 1e-6);
  EXPECT_NEAR(model.errorAtEnd(10).value(), 0.01, 1e-9);
  EXPECT_NEAR(model.errorNow().value(), 0.012, 1e-12);
}

TEST(ProgressModel, ATargetIsMetWhereItIsJudged) {
  ProgressModel model({0, {}, 0.01, [](std::uint64_t photons) { return (photons / 100'000 + 1) * 100'000; }}, 0);
  model.update(10, 100'000, 0);
  model.estimated(0.012, 100'000);  // 144,000 photons give 1 %, which is seen at 200,000
  EXPECT_NEAR(model.secondsLeft(10).value(), 10, 1e-6);
  EXPECT_NEAR(model.errorAtEnd(10).value(), 0.012 / std::sqrt(2.0), 1e-9);
}

TEST(ProgressModel, ErrorsFallWithTheRootOfPhotons) {
  ProgressModel model({400'000, {}, 0}, 0);
  EXPECT_FALSE(model.errorNow().has_value());
  model.update(1, 100'000, 0);
  model.estimated(0.04, 100'000);
  EXPECT_NEAR(model.errorAtEnd(1).value(), 0.02, 1e-12);
}

TEST(ProgressModel, NothingIsKnownWithoutAGoal) {
  ProgressModel model({}, 0);
  model.update(1, 1000, 0);
  EXPECT_FALSE(model.secondsLeft(1).has_value());
  EXPECT_FALSE(model.fraction(1).has_value());
  EXPECT_FALSE(model.errorAtEnd(1).has_value());
}

TEST(ProgressModel, EarlierRunsCountAsDoneNotAsSpeed) {
  ProgressModel model({1000, {}, 0}, 0);
  model.startFrom(500, 0);
  model.update(10, 600, 0);
  EXPECT_NEAR(model.secondsLeft(10).value(), 40, 1e-9);
  EXPECT_NEAR(model.fraction(10).value(), 0.6, 1e-9);
}

}  // namespace
}  // namespace lucarne::progress_model_test
