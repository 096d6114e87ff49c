#include "player/render_scale.h"

#include <algorithm>

namespace lucarne {
namespace {

constexpr double kSlowest = 1.0 / 20, kFastEnough = 1.0 / 40, kRest = 0.3;  // seconds

}  // namespace

void RenderScale::update(double frameSeconds, bool moving) {
  if (!adaptive_) return;
  stillSeconds_ = moving ? 0 : stillSeconds_ + frameSeconds;
  if (!moving) {
    if (stillSeconds_ > kRest) scale_ = full_;
    return;
  }
  if (frameSeconds > kSlowest) scale_ *= 0.8;
  if (frameSeconds < kFastEnough) scale_ *= 1.1;
  scale_ = std::clamp(scale_, 0.5 * full_, full_);
}

}  // namespace lucarne
