#include "base/progress_model.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

/// Seconds after which what was counts 1/e: short enough to follow a machine that others start to use, and a share of
/// the whole so that pauses for saving, and their absence, do not show in the time left.
constexpr double kMemory = 5, kMemoryShare = 0.25;
constexpr double kWarmUp = 0.8;  // seconds

double perSecond(std::uint64_t events, double seconds) {
  return seconds > 0 ? static_cast<double>(events) / seconds : 0;
}

double since(std::uint64_t before, std::uint64_t now) { return static_cast<double>(now - std::min(now, before)); }

}  // namespace

void ProgressModel::startFrom(std::uint64_t photons, std::uint64_t rays) {
  earlierPhotons_ = photons_ = photons;
  earlierRays_ = rays_ = rays;
}

void ProgressModel::update(double now, std::uint64_t photons, std::uint64_t rays) {
  const double elapsed = std::max(0.0, now - last_);
  // Threads touch their memory first: the first second of tracing says little about those to come.
  if (!warm_ && last_ - start_ - paused_ >= kWarmUp) {
    photonRate_ = rayRate_ = {};
    warm_ = true;
  }
  const double keep = std::exp(-elapsed / std::max(kMemory, kMemoryShare * (now - start_)));
  photonRate_.add(since(photons_, photons), elapsed, keep);
  rayRate_.add(since(rays_, rays), elapsed, keep);
  photons_ = photons;
  rays_ = rays;
  last_ = now;
}

void ProgressModel::paused(double from, double to) {
  const double newly = std::max(0.0, to - std::max(from, last_));
  last_ += newly;
  paused_ += newly;
}

void ProgressModel::estimated(double error, std::uint64_t photons) {
  error_ = error;
  errorPhotons_ = static_cast<double>(photons);
}

double ProgressModel::meanPhotonRate(double now) const { return perSecond(photons_ - earlierPhotons_, now - start_ - paused_); }

double ProgressModel::meanRayRate(double now) const { return perSecond(rays_ - earlierRays_, now - start_ - paused_); }

std::optional<double> ProgressModel::errorAt(double photons) const {
  if (errorPhotons_ <= 0 || photons <= 0) return std::nullopt;
  return error_ * std::sqrt(errorPhotons_ / photons);
}

double ProgressModel::photonsForTargetError() const {
  constexpr double kMost = 0x1p62;
  const double ratio = error_ / goal_.targetError;
  const double least = std::max({1.0, static_cast<double>(photons_), errorPhotons_ * ratio * ratio});
  if (!goal_.nextJudged || !(least < kMost)) return least;
  return static_cast<double>(goal_.nextJudged(static_cast<std::uint64_t>(std::ceil(least)) - 1));
}

std::optional<double> ProgressModel::photonsAtEnd() const {
  std::optional<double> end;
  if (goal_.photons > 0) end = static_cast<double>(goal_.photons);
  if (goal_.targetError > 0 && errorPhotons_ > 0) {
    end = std::min(end.value_or(HUGE_VAL), photonsForTargetError());
  }
  return end;
}

std::optional<double> ProgressModel::secondsLeft(double now) const {
  std::optional<double> left;
  if (goal_.seconds) left = std::max(0.0, *goal_.seconds - (now - start_));
  const std::optional<double> end = photonsAtEnd();
  const double rate = photonRate();
  if (!end || !(rate > 0)) return left;
  const double ofPhotons = std::max(0.0, *end - static_cast<double>(photons_)) / rate;
  return std::min(ofPhotons, left.value_or(ofPhotons));
}

std::optional<double> ProgressModel::fraction(double now) const {
  std::optional<double> fraction;
  if (goal_.seconds && *goal_.seconds > 0) fraction = std::min(1.0, (now - start_) / *goal_.seconds);
  const std::optional<double> end = photonsAtEnd();
  if (!end || !(*end > 0)) return fraction;
  return std::max(fraction.value_or(0), std::min(1.0, static_cast<double>(photons_) / *end));
}

std::optional<double> ProgressModel::errorAtEnd(double now) const {
  const std::optional<double> left = secondsLeft(now);
  if (!left) return std::nullopt;
  double photons = static_cast<double>(photons_) + *left * photonRate();
  if (const std::optional<double> end = photonsAtEnd()) photons = std::min(photons, *end);
  return errorAt(photons);
}

}  // namespace lucarne
