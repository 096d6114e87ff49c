#include "app/report_scene.h"

#include <algorithm>

#include "app/bake_command.h"
#include "app/check_features.h"
#include "app/check_layout.h"
#include "app/check_lights.h"
#include "base/system.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr double kFewPhotons = 30;

/// Mean photons of the texels of a side that hold surface, and how much surface that is (local units).
struct SideLight {
  double photons = 0, area = 0;
};

SideLight lightOf(const SideMaps& side, const BakePlan& plan, const LightMaps& maps) {
  const std::uint64_t first = plan.layout.charts[side.chart].firstTexel;
  SideLight light;
  double covered = 0;
  for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
    const double area = plan.layout.area[first + t];
    if (!(area > 0)) continue;
    light.area += area;
    light.photons += static_cast<double>(maps.photons[side.firstTexel + t]);
    ++covered;
  }
  light.photons /= std::max(covered, 1.);
  return light;
}

nlohmann::json hostToJson() {
  const HostDescription host = describeHost();
  return {{"cpu", host.cpu}, {"system", host.system}, {"threads", host.threads}, {"memory_bytes", host.memoryBytes}};
}

nlohmann::json curveToJson(const RateCurve& rates) {
  nlohmann::json seconds = nlohmann::json::array(), photons = nlohmann::json::array();
  for (const RateCurve::Point& p : rates.points()) {
    seconds.push_back(static_cast<double>(p.milliseconds) * 1e-3);
    photons.push_back(p.photons);
  }
  return {{"seconds", seconds}, {"photons", photons}};
}

}  // namespace

void warnOfFewPhotons(const Scene& scene, const BakePlan& plan, const LightMaps& maps, CheckWarnings& warnings) {
  std::vector<std::pair<double, std::string>> poor;
  double all = 0, poorArea = 0;
  std::size_t lit = 0;
  for (const SideMaps& side : maps.sides) {
    if (!side.lit) continue;
    ++lit;
    const SideLight light = lightOf(side, plan, maps);
    all += light.area;
    if (light.photons >= kFewPhotons) continue;
    poorArea += light.area;
    poor.emplace_back(light.area, scene.materials[maps.charts[side.chart].material].name);
  }
  if (poor.empty()) return;
  std::stable_sort(poor.begin(), poor.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (const auto& [area, name] : poor)
    if (std::find(names.begin(), names.end(), name) == names.end() && names.size() < 3) names.push_back(name);
  std::string of;
  for (const std::string& name : names) of += (of.empty() ? "" : ", ") + quotedName(name);
  warnings.add("few_photons", formatCount(poor.size()) + " of " + formatCount(lit) + " lit chart sides (" +
                                  formatPercent(all > 0 ? poorArea / all : 0) + " of their surface) got fewer than " +
                                  formatNumber(kFewPhotons) + " photons a texel, the largest of material " + of +
                                  ": trace more photons, or lower --density");
}

void addMakersToReport(const BakeOptions& options, const PartHeader& header, nlohmann::json& report) {
  report["host"] = hostToJson();
  report["builds"] = nlohmann::json::array();
  std::set<std::string> builds;
  for (const Maker& m : header.makers) builds.insert(m.build);
  for (const std::string& build : builds) report["builds"].push_back(build);
  report["command"] = bakeCommand(options);
  // A bake that was finished before has its curve from an earlier report, or none.
  if (!header.rates.points().empty() || !report.contains("rate_curve"))
    report["rate_curve"] = curveToJson(header.rates);
}

void addSceneToReport(const CheckInput& input, bool skyMissing, const LightMaps* maps, nlohmann::json& report) {
  CheckWarnings warnings, ofLights;
  checkSize(input, warnings);
  const nlohmann::json lights = checkLights(input, skyMissing ? ofLights : warnings);
  if (!skyMissing) report["lights"] = lights["sources"];
  checkLayout(input, warnings);
  if (maps != nullptr) warnOfFewPhotons(input.scene(), input.plan, *maps, warnings);
  report["warnings"] = warnings.list();
}

}  // namespace lucarne
