#include "player/eye_adaptation.h"

#include <cmath>

namespace lucarne {
namespace {

constexpr double kSeconds = 0.4;  // of the eye

}  // namespace

void EyeAdaptation::pass(double seconds) {
  const double share = 1 - std::exp(-seconds / kSeconds);
  exposure_ = first_ ? metered_ : exposure_ * static_cast<float>(std::pow(metered_ / exposure_, share));
  first_ = false;
}

}  // namespace lucarne
