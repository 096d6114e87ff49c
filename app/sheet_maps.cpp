#include "app/sheet_maps.h"

#include <algorithm>
#include <cmath>

#include "base/heat_colour.h"
#include "base/units.h"

namespace lucarne {
namespace {

/// The least of 1, 2, 5, 10 … (times a power of ten) that all but a twentieth of the values lie under.
double roundTop(std::vector<double> values) {
  if (values.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  const double top = values[static_cast<std::size_t>(rank)];
  if (!(top > 0) || !std::isfinite(top)) return 1;
  const double power = std::pow(10, std::floor(std::log10(top)));
  for (const double step : {1., 2., 5.}) {
    if (top <= step * power * (1 + 1e-9)) return step * power;
  }
  return 10 * power;
}

std::vector<double> litValues(const std::vector<float>& values) {
  std::vector<double> lit;
  for (const float v : values) {
    if (v > 0) lit.push_back(static_cast<double>(v));
  }
  return lit;
}

/// A panel of single numbers: `shown` brings a value to 0 … 1.
SheetPanel numberPanel(const LightMaps& maps, bool back, const std::vector<float>& values, std::string title,
                       std::string legend, const std::function<double(double)>& shown) {
  SheetPanel panel{title + (back ? ", backs" : ""), std::move(legend), true, AtlasGrid(maps, kLargePanel),
                   [shown](Vec3d v) { return heatColour(shown(v.x)); }};
  forEachSide(maps, back, [&](const MapChart& chart, const SideMaps& side) {
    panel.grid.addSide(chart, [&](std::uint64_t t) { return Vec3d(static_cast<double>(values[side.firstTexel + t])); });
  });
  return panel;
}

}  // namespace

bool anySide(const LightMaps& maps, bool back) {
  bool any = false;
  forEachSide(maps, back, [&](const MapChart&, const SideMaps&) { any = true; });
  return any;
}

std::vector<double> luminancesOf(const std::vector<Rgb>& values) {
  constexpr std::size_t kEnough = 1 << 20;
  std::vector<double> l;
  for (std::size_t i = 0; i < values.size(); i += 1 + values.size() / kEnough) l.push_back(luminance(Rgbd(values[i])));
  return l;
}

SheetPanel irradiancePanel(const LightMaps& maps, bool back) {
  const SheetExposure exposure(luminancesOf(maps.irradiance));
  SheetPanel panel{back ? "irradiance, backs" : "irradiance", exposure.words(), false, AtlasGrid(maps, kLargePanel),
                   exposure};
  forEachSide(maps, back, [&](const MapChart& chart, const SideMaps& side) {
    panel.grid.addSide(chart, [&](std::uint64_t t) { return Rgbd(maps.irradiance[side.firstTexel + t]); });
  });
  return panel;
}

SheetPanel errorPanel(const LightMaps& maps, bool back) {
  const double top = roundTop(litValues(maps.relativeError));
  return numberPanel(maps, back, maps.relativeError, "estimated relative error",
                     "0 to " + formatPercent(top) + " or more", [top](double v) { return v / top; });
}

SheetPanel photonsPanel(const LightMaps& maps, bool back) {
  const double top = std::max(2., roundTop(litValues(maps.photons)));
  return numberPanel(maps, back, maps.photons, "photons in the texel",
                     "0, then 1 to " + formatNumber(top) + " or more by their logarithm",
                     [top](double v) { return v > 0 ? 0.1 + 0.9 * std::log(std::max(v, 1.)) / std::log(top) : 0; });
}

}  // namespace lucarne
