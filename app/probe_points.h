// Probing a .dlm at points read from text.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace lucarne {

/// A line "x y z nx ny nz" (metres, world) in, one JSON line out; empty lines are skipped. `asText`: a short line for people
/// instead. InputError names the line that is not six finite numbers.
void probePoints(const std::filesystem::path& dlm, std::istream& in, std::ostream& out, bool asText);

}  // namespace lucarne
