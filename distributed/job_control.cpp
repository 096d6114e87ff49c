#include "distributed/job_control.h"

#include <array>
#include <bit>

namespace lucarne {

const char* nameOf(JobEnd end) {
  constexpr std::array<const char*, 5> kNames = {"photons", "time", "target_error", "tallies_full", "interrupted"};
  return kNames[static_cast<std::size_t>(end)];
}

std::uint64_t StopRules::nextJudged(std::uint64_t photons) const {
  if (photons < firstJudged) return firstJudged;
  const std::uint64_t power = std::bit_floor(photons), between = power / 128 * 181;
  if (photons < between) return between;
  return power >= std::uint64_t{1} << 63 ? ~std::uint64_t{0} : 2 * power;
}

bool StopRules::isJudged(std::uint64_t photons) const {
  return photons >= firstJudged && nextJudged(photons - 1) == photons;
}

}  // namespace lucarne
