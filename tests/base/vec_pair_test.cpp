#include "base/vec_pair.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace lucarne::vec_pair_test {
namespace {

TEST(Vec3dPair, GivesTheBitsOfVec3d) {
  std::uint32_t state = 1;
  const auto number = [&] {
    state = state * 1664525 + 1013904223;
    return static_cast<float>(state >> 8) * 0x1p-20f - 8;
  };
  for (int i = 0; i < 1000; ++i) {
    const Vec3f a{number(), number(), number()}, b{number(), number(), number()};
    const double s = static_cast<double>(number());
    const Vec3dPair p(a), q(b);
    const Vec3d u(a), v(b);
    ASSERT_EQ(Vec3d(p + q * s), u + v * s);
    ASSERT_EQ(Vec3d(p - q), u - v);
    ASSERT_EQ(dot(p * s, q), dot(u * s, v));
    ASSERT_EQ(Vec3d(cross(p * s, q)), cross(u * s, v));
  }
}

}  // namespace
}  // namespace lucarne::vec_pair_test
