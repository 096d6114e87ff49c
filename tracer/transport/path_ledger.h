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
    ledger.expectedAbsorbed += absorbed - error;
    ledger.roulette += roulette;
    ledger.shadingNormal += shadingNormal;
    const Int128 sum = Int128{error.units[0]} + error.units[1] + error.units[2];
    ledger.absorptionErrorSquares += sum * sum;
  }
};

}  // namespace lucarne
