// Blocks of samplers as functions of the photon, and their points.
#pragma once

#include <functional>
#include <vector>

#include "tracer/optics/sampler.h"

namespace lucarne::test {

using Words = std::array<std::uint32_t, 4>;

/// A block of a sampler, as a function of the photon's number in its half: those of even or of odd index.
using Block = std::function<Words(std::uint64_t photon)>;

template <class Sampler>
Block block(std::uint64_t seed, std::uint32_t event, Stream stream, bool odd = false) {
  return [=](std::uint64_t photon) { return Sampler(seed, 2 * photon + odd).words(event, stream); };
}

inline std::vector<Words> points(const Block& block, std::uint64_t first, std::uint64_t count) {
  std::vector<Words> p(count);
  for (std::uint64_t i = 0; i < count; ++i) p[i] = block(first + i);
  return p;
}

inline double unit(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

/// Multiples of 2^16 that photons start at, on both sides of 2^32.
inline constexpr std::uint64_t kStarts[] = {0,
                                            std::uint64_t{3} << 20,
                                            (std::uint64_t{1} << 32) - (1u << 16),
                                            std::uint64_t{1} << 32,
                                            (std::uint64_t{5} << 32) + (std::uint64_t{7} << 16),
                                            std::uint64_t{1} << 40,
                                            ~std::uint64_t{0xffff}};

}  // namespace lucarne::test
