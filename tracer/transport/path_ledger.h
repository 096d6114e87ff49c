// What one photon adds to the ledger.
#pragma once

#include "tracer/transport/ledger.h"

namespace lucarne {

/// 64 bits hold any single path.
struct PathLedger {
  FixedRgb absorbed, roulette, shadingNormal;
  FixedRgb error;  // absorbed − expected absorbed: zero at diffuse surfaces

  void addTo(Ledger& ledger) const {
    ledger.absorbed += absorbed;
    ledger.roulette += roulette;
    if (isZero(error)) {
      ledger.expectedAbsorbed += absorbed;
    } else {
      ledger.expectedAbsorbed += absorbed - error;
      const Int128 sum = Int128{error.units[0]} + error.units[1] + error.units[2];
      ledger.absorptionErrorSquares += sum * sum;
    }
    if (!isZero(shadingNormal)) ledger.shadingNormal += shadingNormal;
  }

 private:
  /// Most paths book none of it, and sums of 128 bits cost.
  static bool isZero(const FixedRgb& v) { return (v.units[0] | v.units[1] | v.units[2]) == 0; }
};

}  // namespace lucarne
