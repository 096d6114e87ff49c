#include "tracer/optics/sobol.h"

namespace lucarne {
namespace {

/// One dimension as published: the primitive polynomial's degree and inner coefficients, and the first odd numbers m.
struct JoeKuo {
  std::size_t degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 3> m;
};

/// Direction numbers of a dimension, that of the index's lowest bit first (Bratley and Fox 1988, Algorithm 659, section
/// 2).
constexpr std::array<std::uint32_t, 32> directionNumbers(const JoeKuo& p) {
  std::array<std::uint32_t, 32> v{};
  for (std::size_t i = 0; i < 32; ++i) {
    if (i < p.degree) {
      v[i] = p.m[i] << (31 - i);
      continue;
    }
    v[i] = v[i - p.degree] ^ (v[i - p.degree] >> p.degree);
    for (std::size_t k = 1; k < p.degree; ++k)
      if (p.coefficients >> (p.degree - 1 - k) & 1u) v[i] ^= v[i - k];
  }
  return v;
}

/// Dimension 1 is van der Corput's sequence and has no polynomial.
constexpr std::array<std::uint32_t, 32> vanDerCorput() {
  std::array<std::uint32_t, 32> v{};
  for (std::size_t i = 0; i < 32; ++i) v[i] = std::uint32_t{1} << (31 - i);
  return v;
}

constexpr SobolTable makeTable() {
  const std::array<std::array<std::uint32_t, 32>, 4> v = {vanDerCorput(), directionNumbers({1, 0, {1}}),
                                                          directionNumbers({2, 1, {1, 3}}),
                                                          directionNumbers({3, 1, {1, 3, 1}})};
  SobolTable table{};
  for (std::size_t byte = 0; byte < 4; ++byte)
    for (std::size_t value = 1; value < 256; ++value) {
      const std::size_t low = static_cast<std::size_t>(std::countr_zero(value));
      for (std::size_t d = 0; d < 4; ++d)
        table.bytes[byte][value][d] =
            table.bytes[byte][value & (value - 1)][d] ^ reverseBits(v[d][31 - (8 * byte + low)]);
    }
  return table;
}

}  // namespace

constexpr SobolTable kSobolTable = makeTable();

}  // namespace lucarne
