#include "tracer/optics/sampler.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/statistics.h"

namespace lucarne::sampler_test {
namespace {

// Known answers of Philox4x32-10 from the Random123 distribution (kat_vectors).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, 0), (std::array<std::uint32_t, 4>{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  EXPECT_EQ(philox4x32({0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu}, ~std::uint64_t{0}),
            (std::array<std::uint32_t, 4>{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(philox4x32({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, 0x299f31d0a4093822ull),
            (std::array<std::uint32_t, 4>{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(PhotonSampler, StreamsEventsPhotonsAndSeedsAreAllDifferent) {
  std::set<std::array<std::uint32_t, 4>> seen;
  for (const std::uint64_t seed : {0ull, 1ull, 1ull << 40})
    for (const std::uint64_t photon : {0ull, 1ull, 1ull << 32, 1ull << 40})
      for (std::uint32_t event = 0; event < 3; ++event)
        for (const Stream stream : {Stream::scatter, Stream::emitter, Stream::emission})
          EXPECT_TRUE(seen.insert(PhotonSampler(seed, photon).words(event, stream)).second);
}

TEST(PhotonSampler, NeighbouringPhotonsAreUniformAndIndependentInTwoDimensions) {
  constexpr int n = 32;
  constexpr int samples = 200000;
  std::vector<double> observed(n * n, 0), expected(n * n, samples / double(n * n));
  for (std::uint64_t i = 0; i < samples; ++i) {
    const float x = PhotonSampler(7, i).floats(1, Stream::scatter)[0], y = PhotonSampler(7, i + 1).floats(1, Stream::scatter)[0];
    ++observed[static_cast<std::size_t>(x * n) * n + static_cast<std::size_t>(y * n)];
  }
  EXPECT_GT(test::chiSquareP(observed, expected), 1e-4);
}

TEST(PhotonSampler, UnitNumbersStayBelowOne) {
  EXPECT_LT(toUnitFloat(0xffffffffu), 1.f);
  EXPECT_LT(toUnitDouble(0xffffffffu, 0xffffffffu), 1.0);
}

}  // namespace
}  // namespace lucarne::sampler_test
