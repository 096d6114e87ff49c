// The colours that FLIP reckons with.
#pragma once

#include "base/vec.h"

namespace lucarne {

/// Linear RGB → YyCxCz, the opponent space in which the eye's blur acts: linear, without L*a*b*'s cube root.
Vec3f opponentFromRgb(Rgb linear);
Rgb rgbFromOpponent(Vec3f yCxCz);

/// Linear RGB → CIE L*a*b* of D65, a* and b* scaled by L*/100: dark colours look less colourful (Hunt).
Vec3f huntLabFromRgb(Rgb linear);

/// HyAB: |ΔL| + |Δ(a, b)|, which keeps its meaning for large differences (Abasi, Amani Tehran and Fairchild 2020).
float hyab(Vec3f labA, Vec3f labB);

/// Narkowicz' fit of the ACES curve, of an exposed value; 0 … 1. What FLIP's exposures are chosen for.
float flipToneCurve(float exposed);
/// The exposed value that the curve brings to `shown`, 0 < shown < 1.
double inverseFlipToneCurve(double shown);

}  // namespace lucarne
