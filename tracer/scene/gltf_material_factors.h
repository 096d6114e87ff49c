// Factors of a material: numbers with a range, from a file that may not keep to it.
#pragma once

#include <algorithm>

#include "base/vec.h"
#include "tracer/scene/gltf_json.h"

namespace lucarne {

/// Brings the factors of one material into their ranges and remembers whether it had to.
class MaterialFactors {
 public:
  bool clamped() const { return clamped_; }

  /// `value` is finite, as numberOf and numbersOf give it.
  double within(double value, double least, double most) {
    clamped_ |= value < least || value > most;
    return std::clamp(value, least, most);
  }
  double unit(double value) { return within(value, 0, 1); }
  float unit(const Json& object, const char* key, double fallback, const Place& place) {
    return static_cast<float>(unit(numberOf(object, key, fallback, place)));
  }
  /// The first three of `c`.
  template <std::size_t n>
  Rgb unitColor(const std::array<double, n>& c) {
    return Rgb(Rgbd{unit(c[0]), unit(c[1]), unit(c[2])});
  }

 private:
  bool clamped_ = false;
};

/// A colour without an upper end. Negative or huge, it is an InputError: there is no telling what was meant.
inline Rgb openColor(const std::array<double, 3>& c, const Place& place) {
  for (const double x : c) {
    if (x < 0) place.fail("is negative");
    if (!(x <= 1e30)) place.fail("is too large");
  }
  return Rgb(Rgbd{c[0], c[1], c[2]});
}

}  // namespace lucarne
