// Numbers of photon i: a pure function of (seed, i, event, stream), never of a thread, a rank or what came before.
// Event 0 is the emission, event k ≥ 1 the k-th hit.
//
// Two samplers with one interface, for templates to choose from. A block is the four words of one (event, stream): the
// top 24 bits of each are a number to sample with, the low 8 are free for rounding.
//   RandomSampler  Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3"), key
//                  seed, counter (i, event, stream). All words of all photons are independent.
//   SobolSampler   the block is a four-dimensional low-discrepancy point set over the photons (sobol.h), the blocks are
//                  independent of each other. Each word alone is as uniform as a random one.
#pragma once

#include <array>
#include <cstdint>

#include "tracer/optics/sobol.h"

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
enum class Stream : std::uint32_t { scatter, emitter, emission, coverage, lamp, sky, place };
inline constexpr int kStreamBits = 3;

enum class SamplerKind : std::uint8_t { random, sobol };

/// The emission in four numbers, the block (event 0, emission) made once: what is left of `pick` inside the interval of
/// the emitter that it chose, stretched to [0, 1), is the first number of the position, so that the photons of each
/// emitter are stratified among themselves in all that follows. A pick from another block would deal them out at
/// random.
struct EmissionNumbers {
  double pick;  // 53 bits
  std::array<float, 3> others;
};

namespace detail {

constexpr std::array<float, 4> toUnitFloats(const std::array<std::uint32_t, 4>& w) {
  return {toUnitFloat(w[0]), toUnitFloat(w[1]), toUnitFloat(w[2]), toUnitFloat(w[3])};
}

}  // namespace detail

class RandomSampler {
 public:
  RandomSampler(std::uint64_t seed, std::uint64_t photon) : seed_(seed), photon_(photon) {}
  std::uint64_t photon() const { return photon_; }

  std::array<std::uint32_t, 4> words(std::uint32_t event, Stream stream) const {
    return philox4x32({static_cast<std::uint32_t>(photon_), static_cast<std::uint32_t>(photon_ >> 32), event,
                       static_cast<std::uint32_t>(stream)},
                      seed_);
  }
  std::array<float, 4> floats(std::uint32_t event, Stream stream) const {
    return detail::toUnitFloats(words(event, stream));
  }
  EmissionNumbers emission() const {
    const auto w = words(0, Stream::emitter), u = words(0, Stream::emission);
    return {toUnitDouble(w[0], w[1]), {toUnitFloat(u[1]), toUnitFloat(u[2]), toUnitFloat(u[3])}};
  }

 private:
  std::uint64_t seed_, photon_;
};

/// Number of the set of points of a block.
constexpr std::uint64_t sobolSet(std::uint32_t event, Stream stream) {
  return std::uint64_t{event} << kStreamBits | static_cast<std::uint32_t>(stream);
}
/// What the sets of one half of the photons k·2^32 to (k + 1)·2^32 − 1 are scrambled by; `odd`: the odd ones.
constexpr std::uint64_t sobolKey(std::uint64_t seed, std::uint64_t k, bool odd) {
  return mix64(mix64(seed) + (k << 1 | static_cast<std::uint64_t>(odd)));
}
/// The place of a photon in the sets of its half, reversed.
constexpr std::uint32_t sobolPlace(std::uint64_t photon) {
  return reverseBits(static_cast<std::uint32_t>(photon) >> 1);
}

/// The emission of the block `words`. A word has too few bits to pick among many emitters; those below its last are a
/// hash of it, as Owen's scramble would go on: the pick stays a stratified sequence, and uniform in all 53 bits.
constexpr EmissionNumbers sobolEmission(const std::array<std::uint32_t, 4>& words, std::uint64_t key) {
  return {toUnitDouble(words[0], static_cast<std::uint32_t>(mix64(~key ^ words[0]) >> 32)),
          {toUnitFloat(words[1]), toUnitFloat(words[2]), toUnitFloat(words[3])}};
}

/// Photons of even and of odd index are two halves, independent of each other, so that their difference tells the error
/// of their sum. Those of the photons k·2^32 to (k + 1)·2^32 − 1 of a block that are of one half are one point set,
/// scrambled by a hash of (seed, event, stream, k, half): any 2^m photons of a half that begin at a multiple of 2^(m + 1)
/// are stratified as sobolOwen says.
class SobolSampler {
 public:
  SobolSampler(std::uint64_t seed, std::uint64_t photon)
      : key_(sobolKey(seed, photon >> 32, photon % 2 == 1)),
        photon_(photon),
        reversed_(sobolPlace(photon)) {}
  std::uint64_t photon() const { return photon_; }

  std::array<std::uint32_t, 4> words(std::uint32_t event, Stream stream) const {
    return sobolOwen(reversed_, sobolSeeds(key_, sobolSet(event, stream)));
  }
  std::array<float, 4> floats(std::uint32_t event, Stream stream) const {
    return detail::toUnitFloats(words(event, stream));
  }
  EmissionNumbers emission() const { return sobolEmission(words(0, Stream::emission), key_); }

 private:
  std::uint64_t key_, photon_;
  std::uint32_t reversed_;
};

/// Whose numbers photons get.
struct PhotonSeed {
  std::uint64_t seed = 0;
  SamplerKind kind = SamplerKind::random;
  PhotonSeed(std::uint64_t s, SamplerKind k = SamplerKind::random) : seed(s), kind(k) {}
};

/// Either of the two, chosen when the program runs. All photons of a run take the same branch, which costs nothing that
/// can be measured.
class PhotonSampler {
 public:
  PhotonSampler(const PhotonSeed& seed, std::uint64_t photon)
      : kind_(seed.kind), random_(seed.seed, photon), sobol_(seed.seed, photon) {}
  std::uint64_t photon() const { return random_.photon(); }

  std::array<std::uint32_t, 4> words(std::uint32_t event, Stream stream) const {
    return kind_ == SamplerKind::random ? random_.words(event, stream) : sobol_.words(event, stream);
  }
  std::array<float, 4> floats(std::uint32_t event, Stream stream) const {
    return detail::toUnitFloats(words(event, stream));
  }
  EmissionNumbers emission() const { return kind_ == SamplerKind::random ? random_.emission() : sobol_.emission(); }

 private:
  SamplerKind kind_;
  RandomSampler random_;
  SobolSampler sobol_;
};

}  // namespace lucarne
