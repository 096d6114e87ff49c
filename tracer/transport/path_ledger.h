// What a few photons add to the ledger.
#pragma once

#include "tracer/transport/ledger.h"

namespace lucarne {

/// Sums of 128 bits cost: those of kMost photons are held in 64, which hold eight times any single path.
class PathLedger {
 public:
  static constexpr std::uint32_t kMost = 8;

  FixedRgb emitted, absorbed, escaped, roulette, shadingNormal;
  FixedRgb error;  // of the photon in flight: absorbed − expected absorbed, zero at diffuse surfaces

  void endPhoton(Ledger& ledger) {
    if (!isZero(error)) {
      allErrors_ += error;
      const Int128 sum = Int128{error.units[0]} + error.units[1] + error.units[2];
      ledger.absorptionErrorSquares += sum * sum;
      error = {};
    }
    if (++photons_ == kMost) addTo(ledger);
  }
  /// Between photons.
  void addTo(Ledger& ledger) {
    ledger.emitted += emitted;
    ledger.absorbed += absorbed;
    ledger.expectedAbsorbed += absorbed - allErrors_;
    ledger.escaped += escaped;
    ledger.roulette += roulette;
    ledger.shadingNormal += shadingNormal;
    ledger.photons += photons_;
    *this = {};
  }

 private:
  static bool isZero(const FixedRgb& v) { return (v.units[0] | v.units[1] | v.units[2]) == 0; }

  FixedRgb allErrors_;
  std::uint32_t photons_ = 0;
};

}  // namespace lucarne
