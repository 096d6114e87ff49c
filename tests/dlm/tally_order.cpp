// What content hashes and parts are of: the canonical order of tallies, as docs/part-format.md has it.
#include <gtest/gtest.h>

#include "dlm/tally.h"
#include "tests/support/scene_builder.h"

namespace lucarne::tally_order_test {
namespace {

struct Place {
  std::uint64_t layer, side, map, y, x, channel;
};

/// Another number for every place, set and channel.
std::int64_t valueAt(std::int64_t set, const Place& p) {
  std::uint64_t value = p.layer + 1;
  for (const std::uint64_t digit : {p.side, p.map, p.y, p.x, p.channel}) value = 64 * value + digit;
  return 2 * static_cast<std::int64_t>(value) + set;
}

std::uint64_t wide(int n) { return static_cast<std::uint64_t>(n); }

/// Visits the channels of one layer, [side][map][y][x][channel].
template <class Visit>
void visitLayer(const TallyLayout& layout, std::uint64_t layer, std::uint64_t channels, Visit&& visit) {
  for (std::uint64_t s = 0; s < layout.sides.size(); ++s) {
    const TallySide& side = layout.sides[s];
    const std::uint64_t maps = layer == 1 ? 1 : layout.membersOf(side).mapCount();
    for (std::uint64_t map = 0; map < maps; ++map)
      for (std::uint64_t y = 0; y < wide(side.height); ++y)
        for (std::uint64_t x = 0; x < wide(side.width); ++x)
          for (std::uint64_t c = 0; c < channels; ++c) visit(side, Place{layer, s, map, y, x, c});
  }
}

/// Put where those who count put it: at the first entry of the side, and from there by map and texel.
void fill(const TallyLayout& layout, const Tallies& set, std::int64_t number) {
  const auto inSide = [](const TallySide& side, const Place& p) {
    return p.map * side.texelCount() + p.y * wide(side.width) + p.x;
  };
  visitLayer(layout, 0, kLightChannels, [&](const TallySide& side, const Place& p) {
    set.light()[(side.firstLight + inSide(side, p)) * kLightChannels + p.channel] = valueAt(number, p);
  });
  visitLayer(layout, 1, kStatisticsChannels, [&](const TallySide& side, const Place& p) {
    set.statistics()[(side.firstTexel + inSide(side, p)) * kStatisticsChannels + p.channel] = valueAt(number, p);
  });
  visitLayer(layout, 2, kMomentChannels, [&](const TallySide& side, const Place& p) {
    set.moments()[(side.firstMoment + inSide(side, p)) * kMomentChannels + p.channel] = valueAt(number, p);
  });
}

TEST(Tallies, ContentHashIsOfLightStatisticsAndMomentsBySideMapRowAndColumn) {
  test::SceneBuilder builder;
  Material cloth = test::diffuseMaterial({0.5f, 0.5f, 0.5f});
  cloth.doubleSided = true;
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 0.7, 0}, {0, 0.7, 0}, builder.addMaterial(cloth));
  const Scene scene = builder.build();
  const ChartSet charts = growCharts(scene);
  const TexelLayout texels = layOutTexels(scene, charts, {4, 1000, 1000});
  const DirectionSet directions(2);
  const TallyLayout layout = planTallies(scene, charts, texels, directions, {.keepAllDirections = true, .moments = true});
  ASSERT_EQ(layout.sides.size(), 2u);
  ASSERT_EQ(layout.lightEntries, 2 * layout.texels);  // two maps on either side
  ASSERT_NE(layout.sides[0].width, layout.sides[0].height);

  const Tallies tallies(layout, Tallies::Sets::photonsAndDirect);
  fill(layout, tallies, 0);
  fill(layout, *tallies.direct(), 1);
  Hasher hasher;
  for (const std::int64_t set : {0, 1})
    for (const std::uint64_t layer : {0u, 1u, 2u})
      visitLayer(layout, layer, 3, [&](const TallySide&, const Place& p) {
        hasher.addNumber(static_cast<std::uint64_t>(valueAt(set, p)));
      });
  EXPECT_EQ(tallies.contentHash(), hasher.finish());
}

}  // namespace
}  // namespace lucarne::tally_order_test
