// Glossy surfaces of a reflection-Phong exponent, and directions to look at them.
#pragma once

#include <cmath>

#include "tracer/optics/bsdf.h"
#include "tracer/optics/phong.h"
#include "tracer/scene/scene.h"

namespace lucarne::test {

inline Vec3f directionAt(double theta, double phi) {
  return Vec3f(Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

inline Bsdf coatOnly(float exponent) {
  Bsdf b;
  b.f0 = Rgb{0.8f, 0.5f, 0.2f};
  b.f90 = Rgb{1.f};
  b.alpha = alphaFromPhong(exponent);
  return b;
}

inline Material coat(float exponent) {
  Material m;
  m.baseColor = {0.9f, 0.6f, 0.3f};
  m.metallic = 1;
  m.roughness = roughnessFromPhong(exponent);
  return m;
}

}  // namespace lucarne::test
