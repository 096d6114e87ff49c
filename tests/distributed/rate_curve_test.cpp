// The curve of a bake's speed: few points, none of the night lost.
#include "distributed/rate_curve.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/base/expect_error.h"

namespace lucarne::rate_curve_test {
namespace {

/// A point every quarter of a second, a million photons a second.
RateCurve steadyCurve(std::uint64_t points) {
  RateCurve curve;
  for (std::uint64_t i = 0; i < points; ++i) curve.add({250 * i, 250'000 * i});
  return curve;
}

TEST(RateCurve, StaysSmallHoweverLongTheNight) {
  for (const std::uint64_t points : {1u, 2u, 300u, 401u, 5'000u, 200'000u}) {
    const RateCurve curve = steadyCurve(points);
    EXPECT_LE(curve.points().size(), RateCurve::kMostPoints);
    EXPECT_EQ(curve.points().front(), (RateCurve::Point{0, 0}));
    EXPECT_EQ(curve.points().back(), (RateCurve::Point{250 * (points - 1), 250'000 * (points - 1)}));
    if (points > 400) {
      EXPECT_GT(curve.points().size(), RateCurve::kMostPoints / 5) << "still a curve";
    }
  }
}

TEST(RateCurve, KeepsEveryPhotonOfASlowHour) {
  RateCurve curve;
  std::uint64_t photons = 0;
  for (std::uint64_t second = 0; second <= 8 * 3600; ++second) {
    photons += second / 3600 == 3 ? 100 : 1000;  // the fourth hour is slow
    curve.add({1000 * second, photons});
  }
  double slow = 0;
  for (std::size_t i = 1; i < curve.points().size(); ++i) {
    const auto &a = curve.points()[i - 1], &b = curve.points()[i];
    const double rate =
        1000. * static_cast<double>(b.photons - a.photons) / static_cast<double>(b.milliseconds - a.milliseconds);
    if (rate < 101) slow += static_cast<double>(b.milliseconds - a.milliseconds) * 1e-3;
  }
  EXPECT_NEAR(slow, 3600, 300);
}

TEST(RateCurve, TakesNoPointFromBeforeTheLast) {
  RateCurve curve = steadyCurve(10);
  curve.add({100, 5'000'000'000});
  curve.add({1'000'000, 1});
  EXPECT_EQ(curve.points(), steadyCurve(10).points());
}

TEST(RateCurve, ComesBackFromJsonAndGoesOn) {
  const nlohmann::json json = steadyCurve(3000).toJson();
  RateCurve curve = RateCurve::from(JsonView(json, "curve"));
  EXPECT_EQ(curve.points(), steadyCurve(3000).points());
  curve.add({250 * 3000, 250'000ull * 3000});
  EXPECT_EQ(curve.points().back().milliseconds, 250u * 3000);
}

TEST(RateCurve, RefusesListsThatNoBakeMakes) {
  const auto refusal = [](const char* text) {
    const nlohmann::json json = nlohmann::json::parse(text);
    return errorOf(ExitCode::badInput, [&] { RateCurve::from(JsonView(json, "curve")); });
  };
  EXPECT_NE(refusal("[[1, 2, 3]]").find("2 elements"), std::string::npos);
  EXPECT_NE(refusal("[[5, 2], [4, 3]]").find("before"), std::string::npos);
  EXPECT_NE(refusal("[[5, 2], [6, 1]]").find("before"), std::string::npos);
  refusal("[[-1, 2]]");
  nlohmann::json many = nlohmann::json::array();
  for (int i = 0; i < 1000; ++i) many.push_back({i, i});
  EXPECT_NE(errorOf(ExitCode::badInput, [&] { RateCurve::from(JsonView(many, "curve")); }).find("too many"),
            std::string::npos);
}

}  // namespace
}  // namespace lucarne::rate_curve_test
