// How many pixels are worth drawing: fewer while moving on a slow machine, all of them when standing.
#pragma once

namespace lucarne {

class RenderScale {
 public:
  /// `full`: the scale when standing, 0.5 … 1 or below if asked for.
  explicit RenderScale(double full) : full_(full), scale_(full) {}

  double scale() const { return scale_; }
  /// To be told once a frame. Never below half of the full scale.
  void update(double frameSeconds, bool moving);

 private:
  double full_, scale_, stillSeconds_ = 0;
};

}  // namespace lucarne
