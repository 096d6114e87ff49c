// What is missing from a merge, in words.
#pragma once

#include <string>

#include "distributed/part_header.h"

namespace lucarne {

/// The photons of the whole bake, as far as it was said, that the parts do not hold.
IndexSet missingPhotons(const PartHeader& whole);

/// "3 of 16 parts missing, photons 5M..7.5M; CONSEQUENCE; bake them with: lucarne bake …", in one line. Empty where nothing
/// is missing.
std::string describeGaps(const PartHeader& whole, const std::string& consequence);

}  // namespace lucarne
