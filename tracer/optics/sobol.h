// Owen-scrambled Sobol points, four dimensions at a time.
//
// Sobol's sequence with the direction numbers of Joe and Kuo (2008, "Constructing Sobol sequences with better
// two-dimensional projections", new-joe-kuo-6.21201, dimensions 1 to 4): dimensions 0 and 1 are a (0, 2)-sequence, all
// four together a (3, 4)-sequence in base 2. The order of its points and each dimension are scrambled on their own by
// nested uniform (Owen) permutations made from a hash (Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4)).
// Sets with independent seeds can be padded to as many dimensions as a path needs (ibid., section 4).
//
// The hash makes each bit from itself and the bits below it, an Owen scramble makes it from those above, so everything
// here works on words whose bits are reversed; only the result is turned round.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__SSSE3__)
#include <tmmintrin.h>
#endif

namespace lucarne {

/// Four words side by side: a vector extension of GCC and Clang, one register of any x86-64 and of ARM.
using UInt32x4 [[gnu::vector_size(16)]] = std::uint32_t;

/// Bit 31 changes places with bit 0, and so on. Word: std::uint32_t or UInt32x4.
template <class Word>
[[gnu::always_inline]] constexpr Word reverseBits(Word x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

#if defined(__SSSE3__)
/// The same by looking up half bytes, in a third of the steps.
[[gnu::always_inline]] inline UInt32x4 reverseBits(UInt32x4 x) {
  const __m128i half = _mm_set1_epi8(0x0f);
  const __m128i high = _mm_setr_epi8(0x00, -0x80, 0x40, -0x40, 0x20, -0x60, 0x60, -0x20, 0x10, -0x70, 0x50, -0x30, 0x30,
                                     -0x50, 0x70, -0x10);  // [v]: v's four bits turned round, in the high half
  const __m128i low = _mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
  const __m128i turned =
      _mm_shuffle_epi8(std::bit_cast<__m128i>(x), _mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  return std::bit_cast<UInt32x4>(_mm_or_si128(_mm_shuffle_epi8(high, _mm_and_si128(turned, half)),
                                              _mm_shuffle_epi8(low, _mm_and_si128(_mm_srli_epi16(turned, 4), half))));
}
#endif

/// Nested uniform scramble of a reversed word: each bit is flipped or not as the bits below it and the seed say. The
/// Laine-Karras hash (2011, "Stratified sampling for stochastic transparency") with the steps and constants of Vegdahl
/// (2021, "Building a better LK hash"). The seed should be random in all its bits; any two words are then
/// independent past the bit they first differ in.
template <class Word>
[[gnu::always_inline]] constexpr Word owenReversed(Word x, Word seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// The mixing function of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// [k][v]: the reversed point of a reversed index that is v in byte k and zero elsewhere. 16 KiB; points of whole
/// indices are sums without carry of those of their bytes.
struct alignas(64) SobolTable {
  std::array<std::array<std::array<std::uint32_t, 4>, 256>, 4> bytes;
};
extern const SobolTable kSobolTable;

/// Reversed words of the unscrambled Sobol point of the index whose bits are reversed here.
[[gnu::always_inline]] inline UInt32x4 sobolReversed(std::uint32_t reversedIndex) {
  const auto entry = [&](std::size_t byte) {
    UInt32x4 v;
    std::memcpy(&v, kSobolTable.bytes[byte][(reversedIndex >> (8 * byte)) & 0xffu].data(), sizeof v);
    return v;
  };
  return (entry(0) ^ entry(1)) ^ (entry(2) ^ entry(3));
}

/// What scrambles one set of 2^32 points.
struct SobolSeeds {
  std::uint32_t shuffle;  // of the order of the points
  UInt32x4 scramble;      // of each dimension
};

/// Seeds of set number `set` < 2^62 under `key`, as good as independent from set to set and from key to key.
[[gnu::always_inline]] inline SobolSeeds sobolSeeds(std::uint64_t key, std::uint64_t set) {
  constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;  // SplitMix64 makes its states by counting in these
  const std::uint64_t first = key + 3 * set * kStep;
  const std::uint64_t a = mix64(first), b = mix64(first + kStep), c = mix64(first + 2 * kStep);
  return {static_cast<std::uint32_t>(c >> 32),
          UInt32x4{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32), static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(b >> 32)}};
}

/// Words of a point whose reversed words are `point`.
[[gnu::always_inline]] inline std::array<std::uint32_t, 4> sobolScrambled(UInt32x4 point, UInt32x4 scramble) {
  return std::bit_cast<std::array<std::uint32_t, 4>>(reverseBits(owenReversed(point, scramble)));
}

/// Words of the point of the set, uniform in [0, 2^32). The first 2^m points of a set, and any 2^m from a multiple of
/// 2^m on, are a (3, m, 4)-net: of each dimension alone, and of 0 and 1 together, t is 0.
[[gnu::always_inline]] inline std::array<std::uint32_t, 4> sobolOwen(std::uint32_t reversedIndex,
                                                                     const SobolSeeds& seeds) {
  return sobolScrambled(sobolReversed(owenReversed(reversedIndex, seeds.shuffle)), seeds.scramble);
}

}  // namespace lucarne
