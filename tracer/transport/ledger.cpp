#include "tracer/transport/ledger.h"

namespace lucarne {

Ledger& Ledger::operator+=(const Ledger& o) {
  emitted += o.emitted;
  absorbed += o.absorbed;
  escaped += o.escaped;
  cutOff += o.cutOff;
  roulette += o.roulette;
  shadingNormal += o.shadingNormal;
  expectedAbsorbed += o.expectedAbsorbed;
  incident += o.incident;
  absorptionErrorSquares += o.absorptionErrorSquares;
  photons += o.photons;
  rays += o.rays;
  hits += o.hits;
  storedHits += o.storedHits;
  cutOffPaths += o.cutOffPaths;
  repeatedRays += o.repeatedRays;
  clampedNormals += o.clampedNormals;
  strayValues += o.strayValues;
  return *this;
}

FluxSum Ledger::balance() const {
  FluxSum sum = absorbed;
  sum += escaped;
  sum += cutOff;
  sum += roulette;
  sum += shadingNormal;
  return sum;
}

}  // namespace lucarne
