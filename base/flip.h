// FLIP: how different two pictures look to someone who flips between them.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, "FLIP: A Difference Evaluator for
// Alternating Images"; for pictures without an upper bound Andersson, Nilsson, Shirley and Akenine-Möller 2021,
// "Visualizing Errors in Rendered High Dynamic Range Images". 0: no difference to be seen; 1: as different as two
// colours can be. Both ways round give the same, but for the exposures, which the reference decides.
#pragma once

#include <numbers>
#include <vector>

#include "base/image_file.h"

namespace lucarne {

/// A screen 0.7 m wide, of 3840 pixels, seen from 0.7 m: the authors' default. Pixels per degree of the eye's field.
inline constexpr double kFlipPixelsPerDegree = 3840 * std::numbers::pi / 180;

struct FlipMap {
  int width = 0, height = 0;
  std::vector<float> error;  // [0, 1], top row first
  double mean() const;
  float largest() const;
};

/// The exposures, in stops, under which HDR pictures are looked at: from that which brings the brightest pixel of the
/// reference to 0.85 of the display's white to that which brings its median there, about one stop apart.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 1;
  double at(int i) const { return count > 1 ? start + (stop - start) * i / (count - 1) : start; }
};

/// Of a picture whose median is black the median of its lit pixels counts. At most 24 exposures, wider apart if need
/// be.
FlipExposures flipExposures(const ImageRgb& reference);

/// LDR-FLIP of two pictures of one size: linear RGB as a display emits it, 0 … 1, clamped there. What is not finite
/// counts as black.
FlipMap flipLdr(const ImageRgb& reference, const ImageRgb& test, double pixelsPerDegree = kFlipPixelsPerDegree);

/// HDR-FLIP of two pictures of one size, linear RGB: per pixel the largest LDR-FLIP over the exposures, each tone
/// mapped by Narkowicz' fit of the ACES curve.
FlipMap flipHdr(const ImageRgb& reference, const ImageRgb& test, const FlipExposures& exposures,
                double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace lucarne
