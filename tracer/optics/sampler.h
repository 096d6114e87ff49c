// Random numbers of photon i: a pure function of (seed, i, event, block), never of a thread, a rank or what came before.
//
// Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3"): counter (i, event,
// block), key seed. Event 0 is the emission, event k ≥ 1 the k-th hit.
#pragma once

#include <array>
#include <cstdint>

namespace lucarne {

/// Four random words for one counter value.
constexpr std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::uint64_t seed) {
  std::uint32_t k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(a)};
    k0 += 0x9E3779B9u;
    k1 += 0xBB67AE85u;
  }
  return counter;
}

/// The top 24 bits as a float in [0, 1).
constexpr float toUnitFloat(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
/// 53 bits as a double in [0, 1).
constexpr double toUnitDouble(std::uint32_t high, std::uint32_t low) {
  return static_cast<double>(((std::uint64_t{high} << 32) | low) >> 11) * 0x1p-53;
}

/// What a block of numbers is for; one stream never shares numbers with another.
enum class Stream : std::uint32_t { scatter = 0, emitter = 1, emission = 2 };

class PhotonSampler {
 public:
  PhotonSampler(std::uint64_t seed, std::uint64_t photon) : seed_(seed), photon_(photon) {}
  std::uint64_t photon() const { return photon_; }

  std::array<std::uint32_t, 4> words(std::uint32_t event, Stream stream) const {
    return philox4x32({static_cast<std::uint32_t>(photon_), static_cast<std::uint32_t>(photon_ >> 32), event,
                       static_cast<std::uint32_t>(stream)},
                      seed_);
  }
  std::array<float, 4> floats(std::uint32_t event, Stream stream) const {
    const auto w = words(event, stream);
    return {toUnitFloat(w[0]), toUnitFloat(w[1]), toUnitFloat(w[2]), toUnitFloat(w[3])};
  }

 private:
  std::uint64_t seed_, photon_;
};

}  // namespace lucarne
