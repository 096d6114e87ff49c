// What is missing from a merge, in words.
#pragma once

#include <filesystem>
#include <string>

#include "distributed/part_header.h"

namespace lucarne {

/// The photons of the whole bake, as far as it was said, that the parts do not hold.
IndexSet missingPhotons(const PartHeader& whole);
/// Samples of direct light, likewise; none where it is not gathered.
IndexSet missingSamples(const PartHeader& whole);

/// "3 of 16 parts missing, photons 5M..7.5M". Empty where nothing is missing.
std::string describeGaps(const PartHeader& whole);

/// The commands that bake what is missing into parts in `folder`, in one line.
std::string commandsForGaps(const PartHeader& whole, const std::filesystem::path& folder);

}  // namespace lucarne
