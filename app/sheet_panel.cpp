#include "app/sheet_panel.h"

#include <algorithm>

#include "base/heat_colour.h"

namespace lucarne {
namespace {

constexpr int kBarWidth = 72, kBarHeight = 8;

int scaledTo(int size, int largestSize, int largest) {
  if (largestSize <= largest) return size;
  return std::max(1, static_cast<int>(static_cast<std::int64_t>(size) * largest / largestSize));
}

void drawCaption(const SheetPanel& panel, int x, int y, Canvas& canvas) {
  canvas.write(x, y + 4, panel.title, kSheetText);
  int at = x;
  if (panel.heatBar) {
    for (int i = 0; i < kBarWidth; ++i) canvas.fill(x + i, y + 18, 1, kBarHeight, heatColour((i + 0.5) / kBarWidth));
    at += kBarWidth + 6;
  }
  canvas.write(at, y + 18, panel.legend, {165, 170, 180});
}

}  // namespace

AtlasGrid::AtlasGrid(const LightMaps& maps, int largest)
    : atlasWidth_(std::max(1, maps.atlasWidth)), atlasHeight_(std::max(1, maps.atlasHeight)) {
  const int longer = std::max(atlasWidth_, atlasHeight_);
  width_ = scaledTo(atlasWidth_, longer, largest);
  height_ = scaledTo(atlasHeight_, longer, largest);
  sum_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  count_.resize(sum_.size());
}

void AtlasGrid::add(int x, int y, Vec3d value) {
  const auto cell = [](int at, int cells, int texels) {
    return std::clamp(static_cast<int>(static_cast<std::int64_t>(at) * cells / texels), 0, cells - 1);
  };
  const std::size_t i = index(cell(x, width_, atlasWidth_), cell(y, height_, atlasHeight_));
  sum_[i] += value;
  count_[i] += 1;
}

int drawnLength(const AtlasGrid& grid, int cells, int side) {
  return static_cast<int>(static_cast<std::int64_t>(cells) * side / std::max(grid.width(), grid.height()));
}

void drawPanel(const SheetPanel& panel, int x, int y, int side, Canvas& canvas) {
  drawCaption(panel, x, y, canvas);
  const AtlasGrid& grid = panel.grid;
  const auto at = [&](int cells) { return drawnLength(grid, cells, side); };
  for (int row = 0; row < grid.height(); ++row) {
    for (int column = 0; column < grid.width(); ++column) {
      const DisplayColour c = grid.covered(column, row) ? panel.colour(grid.mean(column, row)) : kNoChart;
      canvas.fill(x + at(column), y + kPanelCaption + at(row), at(column + 1) - at(column), at(row + 1) - at(row), c);
    }
  }
}

}  // namespace lucarne
