// How light becomes colour on a contact sheet.
#pragma once

#include <string>
#include <vector>

#include "base/canvas.h"
#include "base/vec.h"

namespace lucarne {

/// Reinhard, Stark, Shirley and Ferwerda 2002, "Photographic Tone Reproduction": `grey` is shown as 18 % of white,
/// `white` and all above as white.
class SheetExposure {
 public:
  /// Grey is the log average of what is lit, white its brightest thousandth.
  explicit SheetExposure(std::vector<double> luminances);
  DisplayColour operator()(Rgbd light) const;
  /// "grey 12.3 lx, white 456 lx".
  std::string words() const;

 private:
  double grey_ = 1, white_ = 1;
};

}  // namespace lucarne
