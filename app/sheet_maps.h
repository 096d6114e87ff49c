// Panels of what light maps hold beside their directions: irradiance, its error, photons.
#pragma once

#include <vector>

#include "app/sheet_exposure.h"
#include "app/sheet_panel.h"
#include "dlm/light_maps.h"

namespace lucarne {

/// Cells along the longer edge of these panels.
inline constexpr int kLargePanel = 512;

/// Calls use(chart, side) for the lit sides.
template <class Use>
void forEachSide(const LightMaps& maps, bool back, Use use) {
  for (const SideMaps& side : maps.sides) {
    if (side.lit && side.back == back) use(maps.charts[side.chart], side);
  }
}

/// True where some front, or some back, is lit.
bool anySide(const LightMaps& maps, bool back);

/// Of some of the values, where there are very many.
std::vector<double> luminancesOf(const std::vector<Rgb>& values);

SheetPanel irradiancePanel(const LightMaps& maps, bool back);
SheetPanel errorPanel(const LightMaps& maps, bool back);
SheetPanel photonsPanel(const LightMaps& maps, bool back);

}  // namespace lucarne
