// How many pixels are worth drawing: fewer while moving on a slow machine, all of them when standing.
#pragma once

namespace lucarne {

class RenderScale {
 public:
  /// `full`: the scale when standing, or always if not `adaptive`.
  explicit RenderScale(double full, bool adaptive = true) : full_(full), scale_(full), adaptive_(adaptive) {}

  double scale() const { return scale_; }
  /// To be told once a frame. Never below half of the full scale.
  void update(double frameSeconds, bool moving);

 private:
  double full_, scale_, stillSeconds_ = 0;
  bool adaptive_;
};

}  // namespace lucarne
