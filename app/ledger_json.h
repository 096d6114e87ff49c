// The energy ledger in lumens, as reports and manifests carry it.
#pragma once

#include <nlohmann/json.hpp>

#include "tracer/transport/ledger.h"

namespace lucarne {

/// flux_lm: emitted, absorbed, escaped, cut_off, roulette, shading_normal (emitted is the sum of the others), and beside
/// it expected_absorbed, absorbed_standard_error (sum of channels) and incident. `emittedFlux` in lm scales the units.
nlohmann::json ledgerToJson(const Ledger& ledger, double emittedFlux);

}  // namespace lucarne
