#include "app/contact_sheet.h"

#include <algorithm>

#include "app/sheet_exposure.h"
#include "app/sheet_maps.h"
#include "app/sheet_panel.h"
#include "base/error.h"
#include "base/files.h"
#include "base/image_file.h"
#include "base/units.h"
#include "dlm/direction_set.h"

namespace lucarne {
namespace {

constexpr int kMargin = 16, kHeading = 34, kSmallSide = 250, kColumns = 8;
constexpr std::size_t kMostDirections = 64;

/// ψ by descending light, of those that some map is stored of, with the sum of their values.
std::vector<std::pair<double, int>> directionsByLight(const LightMaps& maps) {
  std::vector<double> light(static_cast<std::size_t>(maps.directionCount));
  for (const SideMaps& side : maps.sides) {
    for (const SideDirection& d : side.directions) {
      if (!d.stored()) continue;
      for (std::uint64_t t = 0; t < side.texelCount(); ++t)
        light[d.psi] += luminance(Rgbd(maps.directional[d.first + t]));
    }
  }
  std::vector<std::pair<double, int>> order;
  for (std::size_t psi = 0; psi < light.size(); ++psi) {
    if (light[psi] > 0) order.emplace_back(light[psi], static_cast<int>(psi));
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  return order;
}

std::string toward(Vec3d d) {
  char text[64];
  std::snprintf(text, sizeof text, "toward %.2f %.2f %.2f", d.x, d.y, d.z);
  return text;
}

SheetPanel directionPanel(const LightMaps& maps, const DirectionSet& set, bool back, int psi, double share,
                          const SheetExposure& exposure) {
  SheetPanel panel{
      "psi " + std::to_string(psi) + (back ? ", backs" : "") + "   " + formatPercent(share) + " of the light",
      toward(set.direction(psi)), false, AtlasGrid(maps, kSmallSide), exposure};
  forEachSide(maps, back, [&](const MapChart& chart, const SideMaps& side) {
    for (const SideDirection& d : side.directions) {
      if (d.psi != psi) continue;
      panel.grid.addSide(chart,
                         [&](std::uint64_t t) { return d.stored() ? Rgbd(maps.directional[d.first + t]) : Rgbd{}; });
    }
  });
  return panel;
}

/// Where panels go: in rows, from left to right. Without a canvas it only measures.
class Rows {
 public:
  explicit Rows(int width) : width_(width) {}
  void heading(const std::string& text, Canvas* canvas) {
    endRow();
    if (canvas != nullptr) canvas->write(kMargin, y_ + 6, text, kSheetText, 2);
    y_ += kHeading;
  }
  template <class Make>
  void panel(int side, int heightOfGrid, Canvas* canvas, Make make) {
    if (x_ + side > width_) endRow();
    if (canvas != nullptr) drawPanel(make(), x_, y_, side, *canvas);
    x_ += side + kMargin;
    rowHeight_ = kPanelCaption + heightOfGrid + kMargin;
  }
  int endRow() {
    y_ += rowHeight_;
    rowHeight_ = 0;
    x_ = kMargin;
    return y_;
  }

 private:
  int width_, x_ = kMargin, y_ = kMargin, rowHeight_ = 0;
};

/// Height of a grid of the atlas as drawn in a square of `side` pixels.
int drawnHeight(const LightMaps& maps, int side) {
  const AtlasGrid grid(maps, side);
  return drawnLength(grid, grid.height(), side);
}

int layOut(const Dlm& dlm, const std::string& title, int width, Canvas* canvas) {
  const LightMaps& maps = dlm.maps;
  Rows rows(width);
  rows.heading(title, canvas);
  const int large = drawnHeight(maps, kLargePanel), small = drawnHeight(maps, kSmallSide);
  for (const bool back : {false, true}) {
    if (back && !anySide(maps, back)) continue;
    rows.endRow();
    std::vector<SheetPanel> panels;
    if (canvas != nullptr) panels = {irradiancePanel(maps, back), errorPanel(maps, back), photonsPanel(maps, back)};
    for (std::size_t i = 0; i < 3; ++i) rows.panel(kLargePanel, large, canvas, [&] { return panels[i]; });
  }
  auto order = directionsByLight(maps);
  if (order.empty()) return rows.endRow();
  double sum = 0;
  for (const auto& [light, psi] : order) sum += light;
  const bool cut = order.size() > kMostDirections;
  if (cut) order.resize(kMostDirections);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const DirectionSet set(maps.directionCount);
  const SheetExposure exposure(luminancesOf(maps.directional));
  rows.heading("light by direction, " + exposure.words() +
                   (cut ? ": the " + std::to_string(order.size()) + " of " + std::to_string(maps.directionCount) +
                              " with the most light"
                        : ""),
               canvas);
  for (const bool back : {false, true}) {
    if (back && !anySide(maps, back)) continue;
    rows.endRow();
    for (const auto& [light, psi] : order) {
      rows.panel(kSmallSide, small, canvas,
                 [&, p = psi, l = light] { return directionPanel(maps, set, back, p, l / sum, exposure); });
    }
  }
  return rows.endRow();
}

std::string titleOf(const Dlm& dlm, const std::string& name) {
  std::string title = name;
  if (dlm.manifest.contains("photons") && dlm.manifest["photons"].is_number()) {
    title += "   " + formatCount(static_cast<std::uint64_t>(std::max(0., dlm.manifest["photons"].get<double>()))) +
             " photons";
  }
  return title + "   " + std::to_string(dlm.maps.directionCount) + " directions   " +
         std::to_string(dlm.maps.charts.size()) + " charts   atlas " + std::to_string(dlm.maps.atlasWidth) + " x " +
         std::to_string(dlm.maps.atlasHeight) + " texels";
}

}  // namespace

Canvas contactSheet(const Dlm& dlm, const std::string& name) {
  const int width = kMargin + kColumns * (kSmallSide + kMargin);
  const std::string title = titleOf(dlm, name);
  Canvas canvas(width, layOut(dlm, title, width, nullptr), kSheetBackground);
  layOut(dlm, title, width, &canvas);
  return canvas;
}

void writeContactSheet(const std::filesystem::path& dlm, const std::filesystem::path& picture) {
  if (picture.extension() != ".png") throw UsageError(picture.string() + ": --picture writes a .png");
  checkWritable(picture);
  const Canvas canvas = contactSheet(readDlm(dlm), dlm.filename().string());
  writePng(picture, canvas.width(), canvas.height(), canvas.bytes());
}

}  // namespace lucarne
