// The numbers of photons, made quickly: those that SobolSampler and RandomSampler give, to the last bit. The seeds that
// scramble a Sobol block are the same for all photons of a half (of 2^32): they are made once.
#pragma once

#include <array>
#include <cstdint>

#include "tracer/optics/sampler.h"

namespace lucarne {

/// Seeds of the blocks of one half of the photons k·2^32 to (k + 1)·2^32 − 1.
class HalfSeeds {
 public:
  explicit HalfSeeds(std::uint64_t key) : key_(key), emission_(sobolSeeds(key, sobolSet(0, Stream::emission))) {
    for (std::uint32_t i = 0; i < scatter_.size(); ++i) scatter_[i] = make(i);
  }
  std::uint64_t key() const { return key_; }
  const SobolSeeds& emission() const { return emission_; }
  /// Of scattering at hit `event`.
  SobolSeeds scatter(std::uint32_t event) const {
    if (event < scatter_.size()) [[likely]]
      return scatter_[event];
    return make(event);
  }

 private:
  [[gnu::noinline]] SobolSeeds make(std::uint32_t event) const {
    return sobolSeeds(key_, sobolSet(event, Stream::scatter));
  }

  std::uint64_t key_;
  SobolSeeds emission_;
  std::array<SobolSeeds, 32> scatter_{};  // most photons end before
};

/// Seeds of the photons k·2^32 to (k + 1)·2^32 − 1.
class PhotonNumberSeeds {
 public:
  PhotonNumberSeeds(const PhotonSeed& seed, std::uint64_t k)
      : seed_(seed), k_(k), halves_{HalfSeeds(sobolKey(seed.seed, k, false)), HalfSeeds(sobolKey(seed.seed, k, true))} {}
  const PhotonSeed& seed() const { return seed_; }
  std::uint64_t k() const { return k_; }
  const HalfSeeds& half(bool odd) const { return halves_[odd ? 1 : 0]; }

 private:
  PhotonSeed seed_;
  std::uint64_t k_;
  std::array<HalfSeeds, 2> halves_;
};

/// Of one photon.
class PhotonNumbers {
 public:
  using Words = std::array<std::uint32_t, 4>;

  /// `seeds` must be those of the photon, and outlive its use.
  PhotonNumbers(const PhotonNumberSeeds& seeds, std::uint64_t photon)
      : seeds_(&seeds), half_(&seeds.half(photon % 2 == 1)), photon_(photon), reversed_(sobolPlace(photon)) {}

  /// Which half of the photons it is of.
  bool odd() const { return photon_ % 2 == 1; }
  [[gnu::always_inline]] EmissionNumbers emission() const {
    return isSobol() ? sobolEmission(sobolOwen(reversed_, half_->emission()), half_->key()) : sampler().emission();
  }
  /// Of scattering at hit `event`.
  [[gnu::always_inline]] Words scatter(std::uint32_t event) const {
    return isSobol() ? sobolOwen(reversed_, half_->scatter(event)) : sampler().words(event, Stream::scatter);
  }
  /// For what else may be asked of the photon.
  [[gnu::noinline]] PhotonSampler sampler() const { return {seeds_->seed(), photon_}; }

 private:
  bool isSobol() const { return seeds_->seed().kind == SamplerKind::sobol; }

  const PhotonNumberSeeds* seeds_;
  const HalfSeeds* half_;
  std::uint64_t photon_;
  std::uint32_t reversed_;
};

}  // namespace lucarne
