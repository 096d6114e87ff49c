// Vec3d in two registers, for the few places where the tracer's time goes: x and y side by side, z alone. The same
// operations in the same order as those of Vec3d, so the same bits.
#pragma once

#include "base/vec.h"

namespace lucarne {

/// A vector extension of GCC and Clang.
using Doublex2 [[gnu::vector_size(16)]] = double;

struct Vec3dPair {
  Doublex2 xy;
  double z;
  explicit Vec3dPair(Vec3f v) : xy{static_cast<double>(v.x), static_cast<double>(v.y)}, z(static_cast<double>(v.z)) {}
  Vec3dPair(Doublex2 xy_, double z_) : xy(xy_), z(z_) {}
  explicit operator Vec3d() const { return {xy[0], xy[1], z}; }

  friend Vec3dPair operator+(Vec3dPair a, Vec3dPair b) { return {a.xy + b.xy, a.z + b.z}; }
  friend Vec3dPair operator-(Vec3dPair a, Vec3dPair b) { return {a.xy - b.xy, a.z - b.z}; }
  friend Vec3dPair operator*(Vec3dPair a, double s) { return {a.xy * s, a.z * s}; }
};

inline double dot(Vec3dPair a, Vec3dPair b) {
  const Doublex2 p = a.xy * b.xy;
  return p[0] + p[1] + a.z * b.z;
}

/// (y, −x) of a and b: x and y of the product are b.z·(a.y, −a.x) − a.z·(b.y, −b.x).
inline Vec3dPair cross(Vec3dPair a, Vec3dPair b) {
  const Doublex2 turnedA{a.xy[1], -a.xy[0]}, turnedB{b.xy[1], -b.xy[0]};
  const Doublex2 p = a.xy * turnedB;
  return {turnedA * b.z - turnedB * a.z, p[0] + p[1]};
}

}  // namespace lucarne
