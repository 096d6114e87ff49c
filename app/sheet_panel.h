// One panel of a contact sheet: values in the rectangles of the atlas, made small enough.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/canvas.h"
#include "dlm/light_maps.h"

namespace lucarne {

inline constexpr DisplayColour kSheetBackground{34, 37, 46}, kNoChart{20, 22, 28}, kSheetText{225, 225, 225};

/// Means of what fell into each cell of a grid over the atlas.
class AtlasGrid {
 public:
  /// As many cells as texels, but at most `largest` along a side.
  AtlasGrid(const LightMaps& maps, int largest);
  /// All texels of one side of a chart; `values` has its width × height.
  template <class Value>
  void addSide(const MapChart& chart, Value value) {
    for (int y = 0; y < chart.height; ++y) {
      for (int x = 0; x < chart.width; ++x) {
        add(chart.atlasX + x, chart.atlasY + y,
            value(static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(chart.width) +
                  static_cast<std::uint64_t>(x)));
      }
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool covered(int x, int y) const { return count_[index(x, y)] > 0; }
  Vec3d mean(int x, int y) const { return sum_[index(x, y)] / count_[index(x, y)]; }

 private:
  void add(int x, int y, Vec3d value);
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int atlasWidth_, atlasHeight_, width_, height_;
  std::vector<Vec3d> sum_;
  std::vector<double> count_;
};

struct SheetPanel {
  std::string title, legend;
  bool heatBar = false;  // the legend begins with a bar of the heat colours
  AtlasGrid grid;
  std::function<DisplayColour(Vec3d)> colour;
};

/// Height of title and legend.
inline constexpr int kPanelCaption = 34;
/// Pixels that so many cells take when the grid's longer edge takes `side`.
int drawnLength(const AtlasGrid& grid, int cells, int side);
/// Draws the panel's caption, and below it the grid, its longer edge `side` pixels long.
void drawPanel(const SheetPanel& panel, int x, int y, int side, Canvas& canvas);

}  // namespace lucarne
