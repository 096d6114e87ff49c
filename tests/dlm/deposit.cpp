#include "dlm/deposit.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/scene_builder.h"
#include "tracer/transport/any_sink.h"

namespace lucarne::deposit_test {
namespace {

/// What a sink should have counted, told apart by hand: photon by photon, texel by texel.
struct ByHand {
  DepositSink<false>& sink;
  const TexelMap& map;
  std::map<std::uint64_t, std::pair<float, std::uint32_t>> photon;  // luminance and first word, by texel
  std::vector<std::int64_t> statistics;
  std::uint64_t hits = 0, returns = 0;
  bool odd = false;

  void hit(const PhotonHit& h) {
    sink.hit(h);
    ++hits;
    odd = h.odd;
    const TexelMap::Entry& entry = map[h.hit.triangle];
    const TexelMap::Side& side = map.side(h.hit.back ? entry.back : entry.front);
    const Vec2f st = entry.st0 + entry.e1 * h.hit.b.x + entry.e2 * h.hit.b.y;
    const int x = std::clamp(static_cast<int>(st.x), 0, side.width - 1);
    const int y = std::clamp(static_cast<int>(st.y), 0, side.height - 1);
    const auto [at, isNew] = photon.try_emplace(side.firstTexel + static_cast<std::uint64_t>(y * side.width + x),
                                                luminance(h.beta), h.words[3]);
    if (!isNew) {
      at->second.first += luminance(h.beta);
      ++returns;
    }
  }
  void endPhoton() {
    sink.endPhoton();
    for (const auto& [texel, share] : photon) {
      statistics[texel * kStatisticsChannels + kCount] += 1;
      statistics[texel * kStatisticsChannels + kSquares] += roundUnits(share.first * share.first, share.second);
      if (odd) statistics[texel * kStatisticsChannels + kOdd] += roundUnits(share.first, share.second >> 8);
    }
    photon.clear();
  }
};

TEST(DepositSink, APhotonCountsOnceInATexelWithItsWholeShareSquared) {
  test::SceneBuilder builder;
  // White enough for photons with more hits than a group holds.
  builder.addBox({0, 0, 0}, {1, 1, 1}, builder.addDiffuse({0.97f, 0.98f, 0.96f}, {1, 1, 1}), true);
  const Scene scene = builder.build();
  const ChartSet charts = growCharts(scene);
  const TexelLayout layout = layOutTexels(scene, charts, {3, 1000, 1000});
  const DirectionSet directions(1);
  const TallyLayout tallyLayout = planTallies(scene, charts, layout, directions);
  const TexelMap map(scene, charts, layout, tallyLayout);
  const Tallies tallies(tallyLayout);
  DepositSink<false> sink(map, tallyLayout, directions, LightPart::all, tallies);
  ByHand byHand{sink, map, {}, std::vector<std::int64_t>(tallies.statistics().size()), 0, 0};
  Ledger ledger;
  flyPhotons(PhotonScene(scene), {0, 2000}, 3, {}, byHand, ledger);
  sink.flush();
  EXPECT_GT(byHand.returns, 1000u);
  EXPECT_EQ(sink.sums().storedHits, byHand.hits);
  EXPECT_TRUE(std::equal(byHand.statistics.begin(), byHand.statistics.end(), tallies.statistics().begin()));
}

}  // namespace
}  // namespace lucarne::deposit_test
