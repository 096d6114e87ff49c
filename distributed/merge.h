// Merging parts: all that can be known from their headers first, then one pass over each.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "distributed/part_file.h"

namespace lucarne {

/// Parts whose headers agree.
struct PartSet {
  std::vector<std::filesystem::path> files;
  std::vector<Hash128> contents;  // of each, to notice a file that is exchanged in between
  PartHeader whole;               // of all of them; whole.content is not set
};

/// Reads the headers. Throws Error(mergeRefused) naming the two files and what differs: parts of another scene, other
/// settings (of the kernel only what is not among `chosen`), another layout, photons that both hold; or the one file
/// that is cut short or no part; Error(outOfResource) the one whose addition could make the tallies overflow.
/// InputError for files that cannot be read.
PartSet joinParts(const std::vector<std::filesystem::path>& files, const std::set<std::string>& chosen = {});

/// Adds the tallies of all parts (zero before) and returns the scene, which is kept of the first alone. `progress` is
/// called after each part with the bytes read so far. Error(mergeRefused) for a part that turns out altered.
std::vector<std::uint8_t> sumParts(const PartSet& parts, Tallies& tallies,
                                   const std::function<void(std::uint64_t)>& progress);

/// The same checks without the tallies: memory does not depend on the size of the parts.
void verifyParts(const PartSet& parts, const std::function<void(std::uint64_t)>& progress);

/// A warning when the makers' rays differ, else empty.
std::string makersWarning(const std::set<Maker>& makers);

}  // namespace lucarne
