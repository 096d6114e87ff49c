// The energy ledger as parts keep it: every integer to the last unit.
#pragma once

#include <nlohmann/json.hpp>

#include "base/json.h"
#include "tracer/transport/ledger.h"

namespace lucarne {

/// Sums of 128 bits are decimal text, since JSON readers disagree about large numbers.
nlohmann::json ledgerState(const Ledger& ledger);
/// InputError (naming the view's file and place) for anything that ledgerState() does not write.
Ledger ledgerFromState(const JsonView& state);

}  // namespace lucarne
