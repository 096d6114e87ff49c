#include "distributed/part_header.h"

#include <algorithm>
#include <tuple>

#include "distributed/ledger_state.h"
#include "dlm/tally.h"

namespace lucarne {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "lucarne-part";
constexpr std::uint64_t kVersion = 4;

Hash128 hashAt(const JsonView& view) {
  const std::optional<Hash128> hash = Hash128::parse(view.text());
  if (!hash) view.refuse("must be 32 hexadecimal digits");
  return *hash;
}

IndexSet rangesFrom(const JsonView& list) {
  IndexSet set;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonView pair = list.at(i);
    if (pair.size() != 2) pair.refuse("must have 2 elements");
    const IndexRange range{pair.at(0).count(), pair.at(1).count()};
    if (range.begin >= range.end || range.begin < set.end()) pair.refuse("must be a range after the one before");
    set.add(range);
  }
  return set;
}

json makersToJson(const std::set<Maker>& makers) {
  json list = json::array();
  for (const Maker& m : makers) {
    list.push_back({{"build", m.build},
                    {"ray_caster", m.rayCaster},
                    {"processor", m.processor},
                    {"probe_rays", m.probeRays.hex()}});
  }
  return list;
}

std::set<Maker> makersFrom(const JsonView& list) {
  std::set<Maker> makers;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonView m = list.at(i);
    makers.insert(
        {m.at("build").text(), m.at("ray_caster").text(), m.at("processor").text(), hashAt(m.at("probe_rays"))});
  }
  return makers;
}

/// The first member, in order of names, whose values differ.
std::string differingMember(const json& a, const json& b) {
  const auto valueOf = [](const json& object, const std::string& key) {
    return object.contains(key) ? object[key].dump() : std::string("nothing");
  };
  json all = a;
  all.update(b);
  for (const auto& [key, value] : all.items()) {
    if (valueOf(a, key) != valueOf(b, key)) return key + ": " + valueOf(a, key) + " and " + valueOf(b, key);
  }
  return {};
}

Hash128 hashOf(const json& value) {
  Hasher hasher;
  hasher.addText(value.dump());
  return hasher.finish();
}

const json& flatObject(const JsonView& view) {
  const json& value = view.json();
  const bool flat =
      value.is_object() && std::none_of(value.begin(), value.end(), [](const json& v) { return v.is_structured(); });
  if (!flat) view.refuse("must be an object of plain values");
  return value;
}

constexpr auto kMostSamples = static_cast<std::int64_t>(kMostDirectSamples);

/// What sets of tallies have in common.
json tallySet(const PartHeader& h, const std::string& name, const IndexSet& ranges) {
  json set = {{"name", name},
          {"ranges", toJson(ranges)},
          {"normaliser", ranges.count()},
          {"fixed_point_bits", kFixedPointBits},
          {"layers", {name + ".light", name + ".statistics"}},
          {"light_channels", {"r", "g", "b"}},
          {"statistics_channels", {"count", "m2", "odd"}},
          {"light_entries", h.lightEntries},
          {"texels", h.texels}};
  if (h.momentEntries > 0) {
    set["layers"].push_back(name + ".moments");
    set["moment_channels"] = {"x", "y", "z"};
    set["moment_entries"] = h.momentEntries;
  }
  return set;
}

json photonSet(const PartHeader& h) {
  json set = tallySet(h, "photons", h.photons);
  set["ledger"] = ledgerState(h.ledger);
  return set;
}

json directSet(const PartHeader& h) {
  json set = tallySet(h, "direct", h.direct->samples);
  const DirectCounts& counts = h.direct->counts;
  set["counts"] = {{"places", counts.places}, {"clamped", counts.clamped}, {"stray_values", counts.strayValues}};
  set["microseconds"] = h.direct->microseconds;
  return set;
}

void readPhotonSet(const JsonView& set, PartHeader& h) {
  h.photons = rangesFrom(set.at("ranges"));
  h.lightEntries = set.at("light_entries").count();
  h.texels = set.at("texels").count();
  if (set.has("moment_entries")) h.momentEntries = set.at("moment_entries").count();
  h.ledger = ledgerFromState(set.at("ledger"));
  // A scene without light is not traced, nor one whose stored light is all gathered.
  if (h.ledger.photons != 0 && h.ledger.photons != h.photons.count())
    set.at("ledger").refuse("is of another number of photons");
}

DirectPart directFrom(const JsonView& set) {
  DirectPart direct;
  direct.samples = rangesFrom(set.at("ranges"));
  if (direct.samples.end() > kMostDirectSamples) set.at("ranges").refuse("has more samples than a texel can hold");
  const JsonView counts = set.at("counts");
  direct.counts = {counts.at("places").count(), counts.at("clamped").count(), counts.at("stray_values").count()};
  direct.microseconds = set.at("microseconds").count();
  return direct;
}

}  // namespace

bool operator<(const Maker& a, const Maker& b) {
  const auto key = [](const Maker& m) {
    return std::tie(m.build, m.rayCaster, m.processor, m.probeRays.hi, m.probeRays.lo);
  };
  return key(a) < key(b);
}

Hash128 BakeIdentity::settingsHash() const { return hashOf(settings); }

std::uint64_t PartHeader::tallyBytes() const {
  return 8 * (lightEntries * kLightChannels + texels * kStatisticsChannels + momentEntries * kMomentChannels) *
         (direct ? 2 : 1);
}

Tallies PartHeader::makeTallies() const {
  return Tallies(lightEntries, texels, direct ? Tallies::Sets::photonsAndDirect : Tallies::Sets::photons, momentEntries);
}

void PartHeader::add(const PartHeader& other) {
  sceneName = std::min(sceneName, other.sceneName);
  environmentName = std::min(environmentName, other.environmentName);
  makers.insert(other.makers.begin(), other.makers.end());
  if (!(planned == other.planned))
    planned = {std::max(planned.photons, other.planned.photons), 0, std::max(planned.samples, other.planned.samples)};
  photons.add(other.photons);
  ledger += other.ledger;
  microseconds += other.microseconds;
  rates = {};
  if (!direct) return;
  direct->samples.add(other.direct->samples);
  direct->counts += other.direct->counts;
  direct->microseconds += other.direct->microseconds;
}

std::string difference(const BakeIdentity& a, const BakeIdentity& b, const std::set<std::string>& chosen) {
  if (a.scene != b.scene) return "scene: " + a.scene.hex().substr(0, 8) + " and " + b.scene.hex().substr(0, 8);
  if (const std::string member = differingMember(a.settings, b.settings); !member.empty()) return member;
  json resolveA = a.resolve, resolveB = b.resolve;
  for (const std::string& member : chosen) {
    resolveA.erase(member);
    resolveB.erase(member);
  }
  if (const std::string member = differingMember(resolveA, resolveB); !member.empty()) return member;
  if (a.layout != b.layout) return "layout: " + a.layout.hex().substr(0, 8) + " and " + b.layout.hex().substr(0, 8);
  if (a.emittedFlux != b.emittedFlux) {
    return "emitted_flux_lm: " + json(a.emittedFlux).dump() + " and " + json(b.emittedFlux).dump();
  }
  return {};
}

json toJson(const IndexSet& set) {
  json list = json::array();
  for (const IndexRange& r : set.ranges()) list.push_back({r.begin, r.end});
  return list;
}

json toJson(const PartHeader& h) {
  json planned = {{"photons", h.planned.photons}, {"parts", h.planned.parts}};
  json sets = json::array({photonSet(h)});
  if (h.direct) {
    planned["samples"] = h.planned.samples;
    sets.push_back(directSet(h));
  }
  return {{"format", kFormat},
          {"version", kVersion},
          {"scene_name", h.sceneName},
          {"environment_name", h.environmentName},
          {"scene_hash", h.identity.scene.hex()},
          {"scene_file_hash", h.sceneFile.hex()},
          {"settings", h.identity.settings},
          {"settings_hash", h.identity.settingsHash().hex()},
          {"resolve", h.identity.resolve},
          {"layout_hash", h.identity.layout.hex()},
          {"emitted_flux_lm", h.identity.emittedFlux},
          {"makers", makersToJson(h.makers)},
          {"planned", planned},
          {"microseconds", h.microseconds},
          {"rates", h.rates.toJson()},
          {"scene_bytes", h.sceneBytes},
          {"tally_sets", sets},
          {"content_hash", h.content.hex()}};
}

PartHeader partHeaderFrom(const JsonView& v) {
  if (v.at("format").text() != kFormat) v.at("format").refuse("is not that of a part");
  if (v.at("version").count() != kVersion) v.at("version").refuse("is one that this program does not know");
  PartHeader h;
  h.sceneName = v.at("scene_name").text();
  h.environmentName = v.at("environment_name").text();
  h.identity.scene = hashAt(v.at("scene_hash"));
  h.sceneFile = hashAt(v.at("scene_file_hash"));
  h.identity.settings = flatObject(v.at("settings"));
  h.identity.resolve = flatObject(v.at("resolve"));
  h.identity.layout = hashAt(v.at("layout_hash"));
  h.identity.emittedFlux = v.at("emitted_flux_lm").number();
  constexpr double kMostFlux = 1e36;  // beyond it light maps could not say their numbers in floats
  if (!(h.identity.emittedFlux >= 0 && h.identity.emittedFlux <= kMostFlux))
    v.at("emitted_flux_lm").refuse("is no flux");
  if (hashAt(v.at("settings_hash")) != h.identity.settingsHash()) v.at("settings").refuse("was altered");
  h.makers = makersFrom(v.at("makers"));
  const JsonView planned = v.at("planned");
  h.planned = {planned.at("photons").count(),
               static_cast<std::uint64_t>(planned.at("parts").integer(0, static_cast<std::int64_t>(kMostParts))), 0};
  h.microseconds = v.at("microseconds").count();
  h.rates = RateCurve::from(v.at("rates"));
  h.sceneBytes = v.at("scene_bytes").count();
  const JsonView sets = v.at("tally_sets");
  const bool known = sets.size() == 1 || (sets.size() == 2 && sets.at(1).at("name").text() == "direct");
  if (!known || sets.at(0).at("name").text() != "photons") sets.refuse("has tallies that this program does not know");
  readPhotonSet(sets.at(0), h);
  if (sets.size() == 2) {
    h.direct = directFrom(sets.at(1));
    h.planned.samples = static_cast<std::uint64_t>(planned.at("samples").integer(1, kMostSamples));
  }
  h.content = hashAt(v.at("content_hash"));
  // Unknown members and a normaliser, channels or layers of another kind would mean another format.
  if (toJson(h) != v.json()) v.refuse("has members that this program does not know");
  return h;
}

}  // namespace lucarne
