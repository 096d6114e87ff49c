// From radiance to a picture on a screen: exposure, tone curve, sRGB. display.glsl is the twin for the window.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_file.h"

namespace lucarne {

/// Factor that brings the log average of the lit pixels to middle grey. Pixels darker than a ten-thousandth of the
/// brightest hundredth do not count (a black sky would open the aperture wide), and single bright ones count as the
/// brightest hundredth. 1 for a black picture; finite always.
float autoExposure(const ImageRgb& image);

enum class ToneCurve : std::uint8_t {
  filmic,  // bends highlights and shadows
  plain,   // what is above the screen's white is white
};

/// Exposure values at ISO 100, as cameras count them: radiance 1.2 · 2^EV cd/m² becomes the screen's white (ISO 2720,
/// saturation-based speed, 78 / (100 · 0.65)). 15 is the sun's noon, 5 a lamp-lit room.
double exposureOfEv100(double ev100);
double ev100OfExposure(double exposure);

/// Filmic curve 0..∞ → 0..1 (the fit of Narkowicz 2015 to the ACES curve), per channel.
float filmic(float exposed);
/// Linear 0..1 → sRGB 0..1.
float encodeSrgb(float linear);

/// exposure → curve → sRGB → 8 bits; 3 bytes a pixel, top row first. NaN becomes black.
std::vector<std::uint8_t> toDisplay(const ImageRgb& image, float exposure, ToneCurve curve = ToneCurve::filmic);

}  // namespace lucarne
