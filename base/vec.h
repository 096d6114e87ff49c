// Small vectors and matrices. Plain arithmetic only: no libm beyond sqrt, so that the traced path gives the same bits on
// every processor of one instruction set (docs: reproducibility).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace lucarne {

template <class T>
struct Vec2 {
  T x{}, y{};
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, T s) { return {a.x * s, a.y * s}; }
  friend constexpr Vec2 operator*(T s, Vec2 a) { return a * s; }
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

template <class T>
struct Vec3 {
  T x{}, y{}, z{};
  constexpr Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  constexpr explicit Vec3(T s) : x(s), y(s), z(s) {}
  template <class U>
  constexpr explicit Vec3(const Vec3<U>& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  constexpr Vec3& operator-=(Vec3 b) { return *this = *this - b; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return a * s; }
  friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }  // per component
  friend constexpr Vec3 operator/(Vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

template <class T>
struct Vec4 {
  T x{}, y{}, z{}, w{};
  friend constexpr bool operator==(const Vec4&, const Vec4&) = default;
};

using Vec2f = Vec2<float>;
using Vec2d = Vec2<double>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec4f = Vec4<float>;
using Rgb = Vec3<float>;  // linear Rec. 709
using Rgbd = Vec3<double>;

template <class T>
constexpr T dot(Vec2<T> a, Vec2<T> b) {
  return a.x * b.x + a.y * b.y;
}
template <class T>
constexpr T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(Vec3<T> a) {
  return std::sqrt(dot(a, a));
}
/// Unit vector along `a`; the zero vector stays zero.
template <class T>
Vec3<T> normalize(Vec3<T> a) {
  const T l = length(a);
  return l > T(0) ? a / l : Vec3<T>{};
}
template <class T>
constexpr T maxComponent(Vec3<T> a) {
  return std::max(a.x, std::max(a.y, a.z));
}
template <class T>
constexpr T minComponent(Vec3<T> a) {
  return std::min(a.x, std::min(a.y, a.z));
}
template <class T>
constexpr T mean(Vec3<T> a) {
  return (a.x + a.y + a.z) / T(3);
}
/// Rec. 709 luminance of linear RGB.
template <class T>
constexpr T luminance(Vec3<T> a) {
  return T(0.2126) * a.x + T(0.7152) * a.y + T(0.0722) * a.z;
}
template <class T>
bool isFinite(Vec3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Affine 3×4 map, columns of the linear part then the translation: x' = c0·x + c1·y + c2·z + t.
struct Affine {
  Vec3d c0{1, 0, 0}, c1{0, 1, 0}, c2{0, 0, 1}, t{};
  constexpr Vec3d vector(Vec3d v) const { return c0 * v.x + c1 * v.y + c2 * v.z; }
  constexpr Vec3d point(Vec3d p) const { return vector(p) + t; }
  constexpr double determinant() const { return dot(c0, cross(c1, c2)); }
  friend constexpr Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.c0), a.vector(b.c1), a.vector(b.c2), a.point(b.t)};
  }
};

/// Axis-aligned box; empty while lo > hi.
struct Box {
  Vec3d lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
  void add(Vec3d p) {
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  bool empty() const { return lo.x > hi.x; }
  Vec3d center() const { return (lo + hi) * 0.5; }
  Vec3d extent() const { return hi - lo; }
};

/// Orthonormal basis around unit `n` (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
template <class T>
struct Frame {
  Vec3<T> s, t, n;
  explicit Frame(Vec3<T> n_) : n(n_) {
    const T sign = std::copysign(T(1), n.z);
    const T a = T(-1) / (sign + n.z);
    const T b = n.x * n.y * a;
    s = {T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }
  Vec3<T> toWorld(Vec3<T> v) const { return s * v.x + t * v.y + n * v.z; }
  Vec3<T> toLocal(Vec3<T> v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
};

}  // namespace lucarne
