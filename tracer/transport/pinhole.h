// The rays of a pinhole camera.
#pragma once

#include <cmath>

#include "tracer/scene/scene.h"
#include "tracer/transport/meet.h"

namespace lucarne {

class Pinhole {
 public:
  /// `camera` must outlive this. Width and height of the picture, in any one unit.
  Pinhole(const Camera& camera, double width, double height)
      : camera_(camera), width_(width), height_(height), top_(std::tan(0.5 * camera.yfov)) {}

  /// Through a place of the picture, from its upper left corner.
  RayStart through(double x, double y) const {
    const double aspect = width_ / height_;
    const Vec3d d = camera_.right * ((2 * x / width_ - 1) * top_ * aspect) +
                    camera_.up * ((1 - 2 * y / height_) * top_) - camera_.back;
    return {Vec3f(camera_.position), Vec3f(normalize(d)), kNone};
  }

 private:
  const Camera& camera_;
  double width_, height_;
  double top_;
};

}  // namespace lucarne
