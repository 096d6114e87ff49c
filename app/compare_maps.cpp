#include "app/compare_kinds.h"
#include "app/map_difference.h"
#include "base/error.h"
#include "base/units.h"
#include "dlm/direction_set.h"
#include "dlm/map_surface.h"

namespace lucarne {
namespace {

constexpr double kSameScene = 0.5;  // of A's surfaces that must be found in B

nlohmann::json worstToJson(const WorstPlace& worst) {
  return {{"difference_lx", largestDifference(worst.sample.a, worst.sample.b)},
          {"a_lx", toJson(worst.sample.a)},
          {"b_lx", toJson(worst.sample.b)},
          {"chart", worst.sample.chart},
          {"side", worst.sample.back ? "back" : "front"},
          {"position", toJson(worst.position)}};
}

nlohmann::json chartsToJson(const MapDifference& difference) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < difference.charts.size(); ++i) {
    if (difference.charts[i].empty()) continue;
    nlohmann::json chart = toJson(difference.charts[i], "_lx");
    chart["chart"] = i;
    list.push_back(std::move(chart));
  }
  return list;
}

/// null where the sets differ, or where no surface of both has directions.
nlohmann::json directionalToJson(const MapDifference& difference) {
  if (difference.directional.empty()) return nullptr;
  const DirectionSet set(static_cast<int>(difference.directions.size()));
  nlohmann::json d = toJson(difference.directional, "_lx");
  d["by_direction"] = nlohmann::json::array();
  for (std::size_t psi = 0; psi < difference.directions.size(); ++psi) {
    if (difference.directions[psi].empty()) continue;
    nlohmann::json one = toJson(difference.directions[psi], "_lx");
    one["psi"] = psi;
    one["direction"] = toJson(set.direction(static_cast<int>(psi)));
    d["by_direction"].push_back(std::move(one));
  }
  return d;
}

void checkSameScene(const CompareOptions& options, const MapDifference& difference) {
  const double found = static_cast<double>(difference.samples),
               asked = found + static_cast<double>(difference.withoutCounterpart);
  if (asked == 0) throw InputError(options.a.string() + " has no surface that takes light: nothing to compare");
  if (found >= kSameScene * asked) return;
  throw InputError(options.a.string() + " and " + options.b.string() + " are of different scenes: " +
                   formatPercent(found / asked) + " of the surfaces of one are in the other");
}

}  // namespace

nlohmann::json compareLightMaps(const CompareOptions& options) {
  const Dlm a = readDlm(options.a), b = readDlm(options.b);
  MapDifference difference(a, b);
  const bool same = sameLayout(a, b);
  if (same) {
    compareTexels(a, b, difference);
  } else {
    comparePoints(a, b, options.points, difference);
  }
  checkSameScene(options, difference);
  nlohmann::json irradiance = toJson(difference.irradiance, "_lx");
  irradiance["largest"] = worstToJson(difference.worst);
  const std::optional<double> noise = difference.timesExpectedNoise();
  irradiance["times_expected_noise"] = noise ? finiteOrNull(*noise) : nlohmann::json();
  return {{"kind", "light maps"},
          {"compared", same ? "texel by texel" : "at points"},
          {"samples", difference.samples},
          {"samples_without_counterpart", difference.withoutCounterpart},
          {"surface_m2", difference.irradiance.weight()},
          {"directions", {{"a", a.maps.directionCount}, {"b", b.maps.directionCount}}},
          {"direction_filters", {{"a", nameOf(a.maps.directionFilter)}, {"b", nameOf(b.maps.directionFilter)}}},
          {"irradiance", std::move(irradiance)},
          {"directional", directionalToJson(difference)},
          {"charts", chartsToJson(difference)}};
}

}  // namespace lucarne
