#include "player/walk_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lucarne {
namespace {

constexpr double kWalkMetres = 1.5, kRunFactor = 3, kSteepest = 0.49 * std::numbers::pi;

}  // namespace

WalkCamera::WalkCamera(const Camera& start, double speed)
    : position_(start.position),
      yaw_(std::atan2(start.back.x, start.back.z)),
      pitch_(std::clamp(-std::asin(std::clamp(start.back.y, -1., 1.)), -kSteepest, kSteepest)),
      yfov_(start.yfov),
      speed_(speed) {}

void WalkCamera::move(const WalkInput& input, double seconds) {
  yaw_ -= input.turnX;
  pitch_ = std::clamp(pitch_ - input.turnY, -kSteepest, kSteepest);
  const Vec3d forward{-std::sin(yaw_), 0, -std::cos(yaw_)}, right{std::cos(yaw_), 0, -std::sin(yaw_)};
  const Vec3d step = forward * input.forward + right * input.sideways + Vec3d{0, input.upward, 0};
  const double length = std::max(1.0, std::sqrt(dot(step, step)));  // slanting is no faster
  position_ += step * (speed_ * (input.run ? kRunFactor : 1) * seconds / length);
}

Camera WalkCamera::camera() const {
  Camera c;
  c.position = position_;
  c.yfov = yfov_;
  c.right = {std::cos(yaw_), 0, -std::sin(yaw_)};
  c.back = {std::sin(yaw_) * std::cos(pitch_), -std::sin(pitch_), std::cos(yaw_) * std::cos(pitch_)};
  c.up = cross(c.back, c.right);
  return c;
}

double walkSpeed(const Scene& scene) {
  Box box;
  for (const Vec3f& p : scene.positions) box.add(Vec3d(p));
  if (box.empty()) return 0.3;
  const double size = std::max(length(box.extent()), 1e-6);
  return std::clamp(kWalkMetres / scene.frame.scale, 0.05 * size, 0.5 * size);
}

}  // namespace lucarne
