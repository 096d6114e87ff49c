#include "player/layered_pack.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace lucarne::layered_pack_test {
namespace {

/// Every texel of every layer is taken at most once.
void expectDisjoint(const std::vector<LayeredRect>& rects, const LayeredPacking& packing) {
  std::vector<int> taken(packing.texels());
  ASSERT_EQ(packing.places.size(), rects.size());
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const LayeredPlace p = packing.places[i];
    ASSERT_LE(p.x + rects[i].width, packing.width);
    ASSERT_LE(p.y + rects[i].height, packing.height);
    ASSERT_LE(p.layer + rects[i].layers, packing.layers);
    for (int l = p.layer; l < p.layer + rects[i].layers; ++l) {
      for (int y = p.y; y < p.y + rects[i].height; ++y) {
        for (int x = p.x; x < p.x + rects[i].width; ++x) {
          int& texel = taken[static_cast<std::size_t>((l * packing.height + y) * packing.width + x)];
          ASSERT_EQ(texel, 0) << "rectangle " << i;
          texel = 1;
        }
      }
    }
  }
}

std::vector<LayeredRect> mixedRects(int count) {
  std::vector<LayeredRect> rects;
  for (int i = 0; i < count; ++i) rects.push_back({1 + i * 7 % 23, 1 + i * 5 % 17, 1 + i * 3 % 9});
  return rects;
}

bool isPowerOfTwo(int v) { return v > 0 && (v & (v - 1)) == 0; }

TEST(LayeredPack, RectanglesOfAllDepthsStayApart) {
  const auto rects = mixedRects(300);
  const LayeredPacking packing = packLayered(rects, {16384, 2048});
  expectDisjoint(rects, packing);
  EXPECT_TRUE(isPowerOfTwo(packing.width) && isPowerOfTwo(packing.height));
}

TEST(LayeredPack, WastesLessThanHalfOfAFullLoad) {
  const auto rects = mixedRects(300);
  std::uint64_t used = 0;
  for (const LayeredRect& r : rects) used += static_cast<std::uint64_t>(r.width * r.height * r.layers);
  EXPECT_LT(packLayered(rects, {16384, 2048}).texels(), 2 * used);
}

TEST(LayeredPack, ShallowRectanglesFillWhatDeeperOnesLeft) {
  const std::vector<LayeredRect> rects = {{100, 128, 10}, {128, 128, 9}, {28, 128, 8}};
  const LayeredPacking packing = packLayered(rects, {128, 2048});
  EXPECT_EQ(packing.layers, 19);
  expectDisjoint(rects, packing);
}

TEST(LayeredPack, FewLayersMakeLargerPages) {
  const auto rects = mixedRects(300);
  const LayeredPacking packing = packLayered(rects, {16384, 16});
  EXPECT_LE(packing.layers, 16);
  expectDisjoint(rects, packing);
}

TEST(LayeredPack, NothingGivesOneTexel) { EXPECT_EQ(packLayered({}, {64, 8}).texels(), 1u); }

TEST(LayeredPack, WhatCannotFitIsAnErrorOfResource) {
  for (const LayeredRect& r : {LayeredRect{65, 1, 1}, LayeredRect{1, 65, 1}, LayeredRect{1, 1, 9}}) {
    try {
      packLayered({r}, {64, 8});
      FAIL() << r.width << " " << r.height << " " << r.layers;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::outOfResource);
    }
  }
  EXPECT_THROW(packLayered(std::vector<LayeredRect>(100, {64, 64, 1}), {64, 8}), Error);
}

}  // namespace
}  // namespace lucarne::layered_pack_test
