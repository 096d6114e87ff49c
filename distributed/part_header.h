// What a part says of itself: of which bake it is, how it was made, and what is in it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "base/error.h"
#include "base/hash.h"
#include "base/json.h"
#include "distributed/index_set.h"
#include "distributed/rate_curve.h"
#include "dlm/direct_gather.h"
#include "tracer/transport/ledger.h"

namespace lucarne {

/// A part that cannot be used: cut short, altered, of another kind. An InputError, so that reading one alone exits
/// with 3.
class PartError : public InputError {
 public:
  using InputError::InputError;
};

/// Of which bake: what decides every bit of the tallies, and how maps are made of them. Parts that differ in it are not
/// of one bake.
struct BakeIdentity {
  Hash128 scene;            // of what light touches in it: lightHash()
  nlohmann::json settings;  // flat object: all that photons and tallies depend on, the seed among them
  nlohmann::json resolve;   // flat object: the kernel. Tallies do not depend on it
  Hash128 layout;           // of charts, texels, directions and the order of tallies
  double emittedFlux = 0;   // lm, mean over channels

  Hash128 settingsHash() const;
};

/// A program on a processor. Photons are the same wherever `probeRays` is.
struct Maker {
  std::string build, rayCaster, processor;
  Hash128 probeRays;
  friend bool operator<(const Maker& a, const Maker& b);
  friend bool operator==(const Maker&, const Maker&) = default;
};

/// Into how many parts a bake may be cut.
inline constexpr std::uint64_t kMostParts = 1'000'000;

/// The whole of which a part is a piece, as far as it was said: photons in all, into how many parts they were cut
/// (0: not said, or not all cut alike), and samples of gathered direct light (0: not gathered).
struct BakePlanned {
  std::uint64_t photons = 0, parts = 0, samples = 0;
  friend bool operator==(const BakePlanned&, const BakePlanned&) = default;
};

/// Of the second tally set.
struct DirectPart {
  IndexSet samples;  // of every texel
  DirectCounts counts;
  std::uint64_t microseconds = 0;  // of gathering
};

struct PartHeader {
  std::string sceneName;        // of the file, for people
  std::string environmentName;  // likewise; empty: none
  BakeIdentity identity;
  std::set<Maker> makers;
  BakePlanned planned;
  IndexSet photons;
  Ledger ledger;
  std::uint64_t microseconds = 0;  // of tracing, all runs and machines together
  std::optional<DirectPart> direct;  // none: direct light is not gathered
  RateCurve rates;                   // of tracing; none of a sum of parts, which have no clock in common
  std::uint64_t sceneBytes = 0, lightEntries = 0, texels = 0, momentEntries = 0;
  Hash128 sceneFile;  // of the bytes of the scene in this part, packed as one GLB: cameras, names and all
  Hash128 content;    // of the tallies: content_hash

  /// Takes in the header of another part of the same bake, whose photons and samples this one does not hold. In any order of taking
  /// in, the result is the same, but that the file of the scene stays this one's. Leaves `content` to whoever adds the
  /// tallies.
  void add(const PartHeader& other);
  std::uint64_t tallyBytes() const;
  /// Zero tallies of this size.
  Tallies makeTallies() const;
};

/// Where two identities differ, in words that fit into "… differ in …": "seed: 0 and 1". Empty where they agree.
/// Members of `resolve` that are among `chosen` do not count.
std::string difference(const BakeIdentity& a, const BakeIdentity& b, const std::set<std::string>& chosen = {});

/// [[begin, end], …]
nlohmann::json toJson(const IndexSet& set);
nlohmann::json toJson(const PartHeader& header);
/// InputError for anything that toJson() does not write.
PartHeader partHeaderFrom(const JsonView& json);

}  // namespace lucarne
