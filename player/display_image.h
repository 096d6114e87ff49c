// Pictures for a screen: what each kind of view needs.
#pragma once

#include <optional>
#include <string>

#include "player/tonemap.h"
#include "player/view_kind.h"

namespace lucarne {

struct DisplayOptions {
  ToneCurve curve = ToneCurve::filmic;
  std::optional<double> ev100;  // exposure value at ISO 100; none: automatic
};

struct DisplayedImage {
  std::vector<std::uint8_t> bytes;  // 3 a pixel, top row first
  std::string scale;  // what its colours mean: "exposure value 7.3"; empty for colours that are what they are
  double ev100 = 0;                 // of light: what it was exposed for
};

/// Light is exposed and tone mapped, numbers become heat colours from 0 to heatTop(), colours stay.
DisplayedImage displayImage(const ImageRgb& image, ViewScale scale, const DisplayOptions& options);

/// What the palest heat colour stands for: the value below which 99 in a hundred of the positive ones lie. 1 where none
/// is.
float heatTop(const ImageRgb& image);

}  // namespace lucarne
