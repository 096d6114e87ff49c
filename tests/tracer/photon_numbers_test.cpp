#include "tracer/optics/photon_numbers.h"

#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"
#include "tracer/transport/any_sink.h"

namespace lucarne::photon_numbers_test {
namespace {

constexpr std::uint64_t kBlock = std::uint64_t{1} << 32;

TEST(PhotonNumbers, AreThoseOfTheSamplersInAllEventsOfPhotonsFarApart) {
  for (const SamplerKind kind : {SamplerKind::random, SamplerKind::sobol}) {
    for (const std::uint64_t photon : {std::uint64_t{0}, std::uint64_t{77}, kBlock - 1, 5 * kBlock + 3}) {
      const PhotonSeed seed(9, kind);
      const PhotonNumberSeeds seeds(seed, photon / kBlock);
      const PhotonNumbers numbers(seeds, photon);
      const PhotonSampler sampler(seed, photon);
      EXPECT_EQ(numbers.emission().pick, sampler.emission().pick);
      EXPECT_EQ(numbers.emission().others, sampler.emission().others);
      for (const std::uint32_t event : {1u, 2u, 31u, 32u, 33u, 1024u})
        EXPECT_EQ(numbers.scatter(event), sampler.words(event, Stream::scatter)) << photon << ", " << event;
      EXPECT_EQ(numbers.sampler().words(3, Stream::coverage), sampler.words(3, Stream::coverage));
    }
  }
}

TEST(PhotonNumbers, TheBitsOfFourWordsAreTurnedRoundAsThoseOfOne) {
  std::uint32_t x = 1;
  for (int i = 0; i < 1000; ++i) {
    const UInt32x4 four{x, ~x, x * 3, x << (i % 32)};
    const UInt32x4 turned = reverseBits(four);
    for (int k = 0; k < 4; ++k) ASSERT_EQ(turned[k], reverseBits(static_cast<std::uint32_t>(four[k])));
    x = x * 1664525 + 1013904223;
  }
}

struct FirstHits {
  std::vector<float> places;
  void hit(const PhotonHit& h) {
    if (h.event == 1) places.push_back(h.hit.b.x);
  }
  void endPhoton() {}
};

TEST(PhotonNumbers, ARangeAcrossTheEndOfABlockIsItsTwoPieces) {
  test::SceneBuilder builder;
  builder.addBox({0, 0, 0}, {1, 1, 1}, builder.addDiffuse({0.5f, 0.5f, 0.5f}, {1, 1, 1}), true);
  const Scene scene = builder.build();
  const PhotonScene photons(scene);
  const auto trace = [&](IndexRange range, FirstHits& sink, Ledger& ledger) {
    flyPhotons(photons, range, PhotonSeed(3, SamplerKind::sobol), {}, sink, ledger);
  };
  FirstHits whole, pieces;
  Ledger wholeLedger, piecesLedger;
  trace({kBlock - 20, kBlock + 30}, whole, wholeLedger);
  trace({kBlock - 20, kBlock}, pieces, piecesLedger);
  trace({kBlock, kBlock + 30}, pieces, piecesLedger);
  EXPECT_EQ(whole.places.size(), 50u);
  EXPECT_EQ(whole.places, pieces.places);
  EXPECT_TRUE(wholeLedger.absorbed == piecesLedger.absorbed);
}

TEST(PhotonNumbers, TheLastPhotonsOfAllAreTraced) {
  test::SceneBuilder builder;
  builder.addBox({0, 0, 0}, {1, 1, 1}, builder.addDiffuse({0.5f, 0.5f, 0.5f}, {1, 1, 1}), true);
  const Scene scene = builder.build();
  const PhotonScene photons(scene);
  FirstHits sink;
  Ledger ledger;
  const std::uint64_t last = ~std::uint64_t{0};
  flyPhotons(photons, {last - 5, last}, PhotonSeed(3, SamplerKind::sobol), {}, sink, ledger);
  EXPECT_EQ(ledger.photons, 5u);
}

}  // namespace
}  // namespace lucarne::photon_numbers_test
