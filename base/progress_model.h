// What is known of a long run from how far it has come: its rate, its end, the error then.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

namespace lucarne {

/// What ends the run, whichever comes first.
struct ProgressGoal {
  std::uint64_t photons = 0;      // 0: no limit
  std::optional<double> seconds;  // from its start
  double targetError = 0;         // estimated relative error; 0: none
  // The first count of photons after its argument at which the error is judged; empty: it is at any.
  std::function<std::uint64_t(std::uint64_t)> nextJudged = {};
};

/// Time is seconds of any clock that never goes back.
class ProgressModel {
 public:
  ProgressModel(ProgressGoal goal, double now) : goal_(std::move(goal)), start_(now), last_(now) {}

  /// What earlier runs did: counts as done, not in the rates.
  void startFrom(std::uint64_t photons, std::uint64_t rays);
  void update(double now, std::uint64_t photons, std::uint64_t rays);
  /// From `from` to `to` nothing was traced, and will not be again for long: such time is none of the rates.
  void paused(double from, double to);
  /// `error` was estimated when so many photons were traced.
  void estimated(double error, std::uint64_t photons);

  const ProgressGoal& goal() const { return goal_; }
  std::uint64_t photons() const { return photons_; }
  double seconds(double now) const { return now - start_; }
  /// A second of tracing: lately, and (mean) since the start.
  double photonRate() const { return photonRate_.perSecond(); }
  double rayRate() const { return rayRate_.perSecond(); }
  double meanPhotonRate(double now) const;
  double meanRayRate(double now) const;

  /// Nothing where there is no goal, or nothing is known yet.
  std::optional<double> secondsLeft(double now) const;
  std::optional<double> fraction(double now) const;
  /// Errors fall like 1/√photons from the last estimate on.
  std::optional<double> errorNow() const { return errorAt(static_cast<double>(photons_)); }
  std::optional<double> errorAtEnd(double now) const;

 private:
  /// Events a second, older ones counting less and less.
  struct SmoothRate {
    double events = 0, seconds = 0;
    void add(double newEvents, double newSeconds, double keep) {
      events = events * keep + newEvents;
      seconds = seconds * keep + newSeconds;
    }
    double perSecond() const { return seconds > 0 ? events / seconds : 0; }
  };

  std::optional<double> errorAt(double photons) const;
  /// Photons at the end that the goals of photons and error set.
  std::optional<double> photonsAtEnd() const;
  double photonsForTargetError() const;

  ProgressGoal goal_;
  double start_, last_, paused_ = 0;
  std::uint64_t photons_ = 0, rays_ = 0, earlierPhotons_ = 0, earlierRays_ = 0;
  SmoothRate photonRate_, rayRate_;
  bool warm_ = false;
  double error_ = 0;  // estimated last, at errorPhotons_; 0 photons: never
  double errorPhotons_ = 0;
};

}  // namespace lucarne
