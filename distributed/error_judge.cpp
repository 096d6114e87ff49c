#include "distributed/error_judge.h"

#include <algorithm>

#include "distributed/bake_job.h"

namespace lucarne {
namespace {

constexpr double kFirstPause = 1, kCostFactor = 50;
constexpr double kGrowth = 1.2;  // of photons: with fewer more the error is as good as known

}  // namespace

ErrorJudge::ErrorJudge(const BakeJob& job, std::uint64_t photons)
    : job_(job), judged_(job.rules.isJudged(photons) ? photons - 1 : photons), pause_(kFirstPause) {}

std::uint64_t ErrorJudge::limit(std::uint64_t photons) const {
  return job_.rules.targetError > 0 ? job_.rules.nextJudged(photons) : ~std::uint64_t{0};
}

bool ErrorJudge::due(std::uint64_t photons) const {
  if (!job_.estimateError || photons <= judged_) return false;
  if (job_.rules.targetError > 0) return job_.rules.isJudged(photons);
  return static_cast<double>(photons) >= kGrowth * static_cast<double>(judged_) &&
         std::chrono::duration<double>(Clock::now() - last_).count() >= pause_;
}

bool ErrorJudge::judge(const BakeState& state) {
  const auto start = Clock::now();
  judged_ = state.header.photons.count();
  const double error = job_.estimateError(state);
  last_ = Clock::now();
  const double seconds = std::chrono::duration<double>(last_ - start).count();
  if (job_.estimated) job_.estimated({error, judged_, seconds});
  pause_ = std::max(kFirstPause, kCostFactor * seconds);
  return job_.rules.targetError > 0 && error <= job_.rules.targetError;
}

}  // namespace lucarne
