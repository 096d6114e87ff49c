// Maps of faint directions.
#include "dlm/drop_maps.h"

#include <gtest/gtest.h>

#include <random>

namespace lucarne::drop_maps_test {
namespace {

constexpr int kWidth = 5, kHeight = 4;
constexpr std::size_t kTexels = kWidth * kHeight;

/// Two sides with maps of given strength, with texels that differ; a dark side between them.
struct Maps {
  LightMaps maps;
  LightMaps before;

  explicit Maps(const std::vector<float>& strengths) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> vary(0.5f, 1.5f);
    for (const bool lit : {true, false, true}) {
      SideMaps side;
      side.lit = lit;
      side.width = kWidth;
      side.height = kHeight;
      side.firstTexel = maps.irradiance.size();
      for (std::size_t k = 0; k < strengths.size(); ++k)
        side.directions.push_back({static_cast<std::uint16_t>(k), SideDirection::kEmptyMap});
      if (lit) fill(side, strengths, [&] { return vary(random); });
      maps.sides.push_back(side);
    }
    before = maps;
  }

 private:
  template <class F>
  void fill(SideMaps& side, const std::vector<float>& strengths, F&& vary) {
    maps.irradiance.resize(side.firstTexel + kTexels);
    for (std::size_t k = 0; k < strengths.size(); ++k) {
      if (!(strengths[k] > 0)) continue;
      side.directions[k].first = maps.directional.size();
      for (std::size_t t = 0; t < kTexels; ++t) {
        maps.directional.push_back(Rgb(1.f, 0.8f, 0.5f) * (strengths[k] * vary()));
        maps.irradiance[side.firstTexel + t] += maps.directional.back();
      }
    }
  }
};

/// Light by direction at a texel, dropped maps 0.
std::vector<Rgb> lightAt(const LightMaps& maps, std::size_t side, std::size_t t) {
  std::vector<Rgb> light;
  for (const SideDirection& d : maps.sides[side].directions) light.push_back(d.stored() ? maps.directional[d.first + t] : Rgb{});
  return light;
}

TEST(DropFaintMaps, NoTexelLosesMoreThanTheBoundAndTheRestIsUnchanged) {
  for (const double bound : {0.001, 0.01, 0.05, 0.3}) {
    Maps m({100, 30, 3, 1, 0.3f, 0, 0.1f, 0.01f});
    const DroppedMaps dropped = dropFaintMaps(m.maps, bound);
    double worst = 0;
    std::uint64_t gone = 0;
    for (const std::size_t s : {0u, 2u}) {
      double mean = 0;
      for (std::size_t t = 0; t < kTexels; ++t)
        mean += static_cast<double>(luminance(m.maps.irradiance[m.maps.sides[s].firstTexel + t])) / kTexels;
      for (std::size_t t = 0; t < kTexels; ++t) {
        const auto was = lightAt(m.before, s, t), is = lightAt(m.maps, s, t);
        double lost = 0;
        for (std::size_t k = 0; k < was.size(); ++k) {
          if (m.maps.sides[s].directions[k].stored()) {
            const bool grey = is[k].x == is[k].y && is[k].y == is[k].z;
            EXPECT_TRUE(was[k] == is[k] || (grey && std::abs(luminance(was[k]) - luminance(is[k])) <= 1e-5f * is[k].x));
          } else {
            lost += static_cast<double>(luminance(was[k]));
          }
        }
        const auto own = static_cast<double>(luminance(m.maps.irradiance[m.maps.sides[s].firstTexel + t]));
        worst = std::max(worst, lost / std::max(own, mean));
      }
      for (std::size_t k = 0; k < m.before.sides[s].directions.size(); ++k)
        gone += m.before.sides[s].directions[k].stored() && !m.maps.sides[s].directions[k].stored();
    }
    EXPECT_LE(worst, bound);
    EXPECT_NEAR(worst, dropped.lost, 1e-6);
    EXPECT_EQ(gone, dropped.maps);
    EXPECT_GT(gone, 0u);
    EXPECT_EQ(m.maps.directional.size() + dropped.texels, dropped.storedTexels);
    EXPECT_EQ(m.maps.irradiance, m.before.irradiance);
  }
}

TEST(DropFaintMaps, NextToNeutralMapsLoseTheirColourAndNoComponentMovesByMoreThanTheBound) {
  constexpr double kBound = 0.01;
  Maps m({100, 100});
  for (const std::size_t s : {0u, 2u}) {
    const SideMaps& side = m.maps.sides[s];
    for (std::size_t t = 0; t < kTexels; ++t) {
      Rgb& v = m.maps.directional[side.directions[1].first + t];
      v = Rgb(luminance(v)) + Rgb(s == 0 ? 0.5f : 5.f, 0.f, 0.f);
    }
  }
  const LightMaps before = m.maps;
  const DroppedMaps dropped = dropFaintMaps(m.maps, kBound);
  EXPECT_EQ(dropped.neutralTexels, kTexels);
  for (std::size_t i = 0; i < before.directional.size(); ++i) {
    EXPECT_NEAR(luminance(m.maps.directional[i]), luminance(before.directional[i]), 1e-3f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m.maps.directional[i][c], before.directional[i][c], 0.5f);
  }
  const auto greyAt = [&](std::size_t s, std::size_t k) {
    const Rgb v = m.maps.directional[m.maps.sides[s].directions[k].first];
    return v.x == v.y && v.y == v.z;
  };
  EXPECT_TRUE(greyAt(0, 1));
  EXPECT_FALSE(greyAt(0, 0));
  EXPECT_FALSE(greyAt(2, 1));
}

TEST(DropFaintMaps, ABoundOfNothingLeavesAll) {
  Maps m({100, 1e-6f});
  EXPECT_EQ(dropFaintMaps(m.maps, 0).maps, 0u);
  EXPECT_EQ(m.maps.directional, m.before.directional);
}

TEST(DropFaintMaps, AMapThatIsFaintOnAverageButBrightAtOneTexelStays) {
  Maps m({100, 1e-4f});
  m.maps.directional[m.maps.sides[0].directions[1].first + 7] = Rgb(60.f);
  dropFaintMaps(m.maps, 0.01);
  EXPECT_TRUE(m.maps.sides[0].directions[1].stored());
  EXPECT_FALSE(m.maps.sides[2].directions[1].stored());
}

}  // namespace
}  // namespace lucarne::drop_maps_test
