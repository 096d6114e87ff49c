#include "app/merge_gaps.h"

#include <algorithm>
#include <cctype>

#include "app/bake_command.h"
#include "app/bake_identity.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr std::size_t kMostCommands = 4;

/// Whole parts that are missing; empty unless they are all that is missing.
std::vector<std::uint64_t> missingParts(const PartHeader& whole, const IndexSet& missing) {
  std::vector<std::uint64_t> numbers;
  std::uint64_t photons = 0;
  for (std::uint64_t k = 1; k <= whole.planned.parts; ++k) {
    const IndexRange share = shareOf(whole.planned.photons, k, whole.planned.parts);
    if (share.size() == 0 || !missing.contains(share)) continue;
    numbers.push_back(k);
    photons += share.size();
  }
  if (photons != missing.count()) numbers.clear();
  return numbers;
}

std::string stemOf(const std::string& sceneName) {
  const std::string name = sceneName == kBuiltinSceneName ? "glossy_room" : sceneName;
  return name.substr(0, name.find_last_of('.'));
}

/// Commands for at most kMostCommands pieces, and how many more there are.
template <class Piece>
std::string commands(const PartHeader& whole, const std::filesystem::path& folder, const std::vector<Piece>& pieces,
                     const auto& nameOf, const auto& optionOf) {
  std::string text;
  for (std::size_t i = 0; i < std::min(pieces.size(), kMostCommands); ++i) {
    const std::string output = (folder / (stemOf(whole.sceneName) + "-" + nameOf(pieces[i]) + ".part")).string();
    text += (i == 0 ? "" : " && ") + bakeCommand(whole, output, optionOf(pieces[i]));
  }
  if (pieces.size() > kMostCommands)
    text += " … and " + std::to_string(pieces.size() - kMostCommands) + " more like these";
  return text;
}

}  // namespace

IndexSet missingPhotons(const PartHeader& whole) {
  return whole.photons.missing({0, std::max(whole.planned.photons, whole.photons.end())});
}

IndexSet missingSamples(const PartHeader& whole) {
  if (!whole.direct) return {};
  const IndexSet& samples = whole.direct->samples;
  return samples.missing({0, std::max(whole.planned.samples, samples.end())});
}

std::string describeGaps(const PartHeader& whole) {
  const IndexSet missing = missingPhotons(whole);
  const IndexSet samples = missingSamples(whole);
  const std::string direct = samples.empty() ? "" : "samples of direct light " + toText(samples);
  if (missing.empty()) return direct.empty() ? "" : direct + " missing";
  const std::string both = "photons " + toText(missing) + (direct.empty() ? "" : " and " + direct);
  const std::vector<std::uint64_t> parts = missingParts(whole, missing);
  if (parts.empty()) return both + " missing";
  return std::to_string(parts.size()) + " of " + std::to_string(whole.planned.parts) + " parts missing, " + both;
}

std::string commandsForGaps(const PartHeader& whole, const std::filesystem::path& folder) {
  const IndexSet missing = missingPhotons(whole);
  if (const std::vector<std::uint64_t> parts = missingParts(whole, missing); !parts.empty()) {
    const auto option = [&](std::uint64_t k) {
      return "--part " + std::to_string(k) + "/" + std::to_string(whole.planned.parts);
    };
    return commands(
        whole, folder, parts, [](std::uint64_t k) { return std::to_string(k); }, option);
  }
  const auto from = [](const IndexRange& r) { return "from-" + formatExactCount(r.begin); };
  const auto range = [](const IndexRange& r) {
    return "--photon-range " + formatExactCount(r.begin) + ":" + formatExactCount(r.end);
  };
  return commands(whole, folder, missing.ranges(), from, range);
}

}  // namespace lucarne
