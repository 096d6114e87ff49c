#include "base/hash.h"

#include <gtest/gtest.h>

#include <vector>

namespace lucarne::hash_test {
namespace {

std::vector<std::uint8_t> someBytes(std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(i * 2654435761u >> 5);
  return bytes;
}

// From the reference implementation: XXH3_128bits of nothing, seed 0 (xxHash's tests/sanity_test_vectors.h).
TEST(Hash, OfNothingIsThePublishedValue) {
  EXPECT_EQ(hashBytes({}).hex(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(Hasher().finish(), hashBytes({}));
}

TEST(Hash, HexReadsBack) {
  const Hash128 hash{0x0123456789abcdefu, 0x00000000000000ffu};
  EXPECT_EQ(hash.hex(), "0123456789abcdef00000000000000ff");
  EXPECT_EQ(Hash128::parse(hash.hex()), hash);
  for (const char* bad : {"", "0123456789abcdef00000000000000f", "0123456789ABCDEF00000000000000ff",
                          "0123456789abcdef00000000000000fff", "g123456789abcdef00000000000000ff"}) {
    EXPECT_FALSE(Hash128::parse(bad)) << bad;
  }
}

TEST(Hash, PiecesGiveTheHashOfTheWhole) {
  const std::vector<std::uint8_t> bytes = someBytes(5000);
  for (const std::size_t piece : {1u, 7u, 256u, 1024u, 4999u}) {
    Hasher hasher;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      hasher.add(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    }
    EXPECT_EQ(hasher.finish(), hashBytes(bytes));
    EXPECT_EQ(hasher.finish(), hashBytes(bytes)) << "finishing changed the state";
  }
}

TEST(Hash, NumbersAreTheirLittleEndianBytes) {
  Hasher numbers, bytes;
  const std::vector<std::int64_t> values = {1, -2};
  numbers.add(std::as_bytes(std::span(values)));
  numbers.addNumber(0x0102030405060708u);
  bytes.add(std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0, 0, 0, 0xfe, 255, 255, 255, 255, 255, 255, 255});
  bytes.add(std::vector<std::uint8_t>{8, 7, 6, 5, 4, 3, 2, 1});
  EXPECT_EQ(numbers.finish(), bytes.finish());
}

TEST(Hash, TextsDoNotRunIntoEachOther) {
  Hasher a, b;
  a.addText("ab");
  a.addText("c");
  b.addText("a");
  b.addText("bc");
  EXPECT_NE(a.finish(), b.finish());
}

TEST(Hash, OneBitChangesIt) {
  std::vector<std::uint8_t> bytes = someBytes(1000);
  const Hash128 before = hashBytes(bytes);
  bytes[500] ^= 1;
  EXPECT_NE(hashBytes(bytes), before);
}

}  // namespace
}  // namespace lucarne::hash_test
