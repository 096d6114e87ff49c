// The energy ledger in lumens, as reports and manifests carry it.
#pragma once

#include <nlohmann/json.hpp>

#include "distributed/part_header.h"

namespace lucarne {

/// flux_lm: emitted, absorbed, escaped, cut_off, roulette, shading_normal (emitted is the sum of the others), and beside
/// it expected_absorbed, absorbed_standard_error (sum of channels) and incident. `emittedFlux` in lm scales the units.
nlohmann::json ledgerToJson(const Ledger& ledger, double emittedFlux);

/// How direct light was brought: mode, and of gathered light samples, their ranges, seconds, and values that were clamped
/// or dropped.
nlohmann::json directToJson(const PartHeader& header);

}  // namespace lucarne
