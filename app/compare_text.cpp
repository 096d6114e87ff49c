// The text of a comparison, made from its JSON, so that both say the same.
#include <algorithm>

#include "app/compare.h"
#include "base/units.h"

namespace lucarne {
namespace {

using Json = nlohmann::json;

std::string number(const Json& value) { return value.is_number() ? formatNumber(value.get<double>()) : "unknown"; }
std::string percent(const Json& value) { return value.is_number() ? formatPercent(value.get<double>()) : "unknown"; }

std::string triple(const Json& v) { return number(v[0]) + " " + number(v[1]) + " " + number(v[2]); }

void line(std::string& text, const std::string& key, const std::string& value) {
  constexpr std::size_t kColumn = 22;
  text += key + std::string(kColumn - std::min(kColumn - 1, key.size()), ' ') + value + "\n";
}

/// What pictures and light maps have in common; `unit` as in the names of the members.
void commonLines(std::string& text, const Json& d, const std::string& unit) {
  const std::string spoken = unit.empty() ? "" : " lx";
  line(text, "RMSE", number(d["rmse" + unit]) + spoken);
  line(text, "relative error", percent(d["relative_error"]));
  line(text, "mean of A", triple(d["mean_a" + unit]) + spoken);
  line(text, "mean of B", triple(d["mean_b" + unit]) + spoken + ", " + number(d["mean_ratio"]) + " times A");
}

std::string picturesText(const Json& d) {
  std::string text;
  line(text, "pictures", d["width"].dump() + " x " + d["height"].dump() + ", " + d["values"].get<std::string>());
  if (d["non_finite_pixels"] != 0) line(text, "not finite", d["non_finite_pixels"].dump() + " pixels, left out");
  if (d["largest"].is_null()) return text;
  commonLines(text, d, "");
  line(text, "relative MSE", number(d["relative_mse"]));
  line(text, "largest difference",
       number(d["largest_difference"]) + " at pixel " + d["largest"]["pixel"][0].dump() + ", " +
           d["largest"]["pixel"][1].dump() + ": A " + triple(d["largest"]["a"]) + ", B " + triple(d["largest"]["b"]));
  const Json& flip = d["flip"];
  std::string how = flip["kind"].get<std::string>() + "-FLIP";
  if (flip["kind"] == "HDR") {
    how += ", " + flip["exposures"].dump() + " exposures of " + number(flip["first_exposure_stops"]) + " to " +
           number(flip["last_exposure_stops"]) + " stops";
  }
  line(text, "FLIP", number(flip["mean"]) + ", at most " + number(flip["largest"]) + " (" + how + ")");
  return text;
}

/// The rows with the largest relative errors among those with a hundredth of the light or more.
std::vector<Json> worstRows(const Json& rows, std::size_t count) {
  double most = 0;
  const auto light = [](const Json& r) { return r["mean_a_lx"][1].get<double>() + r["mean_b_lx"][1].get<double>(); };
  for (const Json& r : rows) most = std::max(most, light(r));
  std::vector<Json> worst;
  for (const Json& r : rows) {
    if (r["relative_error"].is_number() && light(r) >= 0.01 * most) worst.push_back(r);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Json& x, const Json& y) { return x["relative_error"] > y["relative_error"]; });
  if (worst.size() > count) worst.resize(count);
  return worst;
}

void directionalLines(std::string& text, const Json& d) {
  if (d["directional"].is_null()) {
    const bool sameSet = d["directions"]["a"] == d["directions"]["b"];
    const Json& filters = d["direction_filters"];
    line(text, "directions",
         sameSet && filters["a"] != filters["b"]
             ? filters["a"].get<std::string>() + " and " + filters["b"].get<std::string>() +
                   ": of different filters only the irradiance is compared"
         : sameSet
             ? "no surface of both has maps by direction"
              : d["directions"]["a"].dump() + " and " + d["directions"]["b"].dump() +
                    ": of different sets only the irradiance is compared");
    return;
  }
  line(text, "by direction",
       "RMSE " + number(d["directional"]["rmse_lx"]) + " lx, relative error " +
           percent(d["directional"]["relative_error"]) + " over " + d["directions"]["a"].dump() + " directions");
  for (const Json& r : worstRows(d["directional"]["by_direction"], 3)) {
    line(text, "  psi " + r["psi"].dump(),
         "relative error " + percent(r["relative_error"]) + ", mean " + number(r["mean_ratio"]) + " times A, toward " +
             triple(r["direction"]));
  }
}

std::string mapsText(const Json& d) {
  std::string text;
  line(text, "light maps",
       d["compared"].get<std::string>() + ", " + formatCount(d["samples"].get<std::uint64_t>()) + " samples on " +
           number(d["surface_m2"]) + " m2");
  if (d["samples_without_counterpart"] != 0) {
    line(text, "without counterpart",
         formatCount(d["samples_without_counterpart"].get<std::uint64_t>()) + " points of A, left out");
  }
  const Json& e = d["irradiance"];
  commonLines(text, e, "_lx");
  line(text, "noise",
       e["times_expected_noise"].is_null()
           ? std::string("the maps tell no errors")
           : "the difference is " + number(e["times_expected_noise"]) + " times what the maps' own errors let expect");
  const Json& at = e["largest"];
  line(text, "largest difference",
       number(at["difference_lx"]) + " lx at " + triple(at["position"]) + " (" + at["side"].get<std::string>() +
           " of chart " + at["chart"].dump() + "): A " + triple(at["a_lx"]) + ", B " + triple(at["b_lx"]));
  directionalLines(text, d);
  for (const Json& r : worstRows(d["charts"], 3)) {
    line(text, "chart " + r["chart"].dump(),
         "relative error " + percent(r["relative_error"]) + ", RMSE " + number(r["rmse_lx"]) + " lx");
  }
  return text;
}

}  // namespace

std::string compareText(const Json& compared) {
  return compared["kind"] == "pictures" ? picturesText(compared) : mapsText(compared);
}

}  // namespace lucarne
