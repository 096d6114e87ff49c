#include "app/ledger_json.h"

#include <cmath>

namespace lucarne {

nlohmann::json ledgerToJson(const Ledger& ledger, double emittedFlux) {
  const double scale = ledger.photons == 0 ? 0
                                           : emittedFlux / static_cast<double>(ledger.photons) /
                                                 static_cast<double>(kFixedPointOne);
  const auto lumens = [&](const FluxSum& sum) {
    nlohmann::json rgb = nlohmann::json::array();
    for (const Int128 units : sum.units) rgb.push_back(static_cast<double>(units) * scale);
    return rgb;
  };
  return {{"flux_lm",
           {{"emitted", lumens(ledger.emitted)},
            {"absorbed", lumens(ledger.absorbed)},
            {"escaped", lumens(ledger.escaped)},
            {"cut_off", lumens(ledger.cutOff)},
            {"roulette", lumens(ledger.roulette)},
            {"shading_normal", lumens(ledger.shadingNormal)}}},
          {"ledger_balances", ledger.balance() == ledger.emitted},
          {"expected_absorbed_lm", lumens(ledger.expectedAbsorbed)},
          {"absorbed_standard_error_lm", std::sqrt(static_cast<double>(ledger.absorptionErrorSquares)) * scale},
          {"incident_lm", lumens(ledger.incident)},
          {"rare_events",
           {{"cut_off_paths", ledger.cutOffPaths},
            {"repeated_rays", ledger.repeatedRays},
            {"clamped_shading_normals", ledger.clampedNormals},
            {"stray_values", ledger.strayValues}}}};
}

nlohmann::json directToJson(const PartHeader& h) {
  if (!h.direct) return {{"mode", "photons"}};
  return {{"mode", "gathered"},
          {"samples", h.direct->samples.count()},
          {"sample_ranges", toJson(h.direct->samples)},
          {"seconds", static_cast<double>(h.direct->microseconds) * 1e-6},
          {"clamped", h.direct->counts.clamped},
          {"stray_values", h.direct->counts.strayValues}};
}

}  // namespace lucarne
