// The one map between Phong exponents and glTF roughness.
//
// A reflection-Phong lobe of exponent n looks like a Blinn lobe of exponent 4n (the half vector turns at half the angle, so its
// cosine lobe is four times as sharp), and a Blinn lobe of exponent m like GGX of α² = 2/(m+2) (Walter et al. 2007). Hence
// α² = 2/(4n+2) = 1/(2n+1), and roughness = √α.
#pragma once

#include <algorithm>
#include <cmath>

namespace lucarne {

inline float alphaFromPhong(float exponent) { return std::sqrt(1.f / (2.f * std::max(exponent, 0.f) + 1.f)); }
inline float phongFromAlpha(float alpha) { return std::max(0.f, 0.5f * (1.f / (alpha * alpha) - 1.f)); }
inline float roughnessFromPhong(float exponent) { return std::sqrt(alphaFromPhong(exponent)); }

}  // namespace lucarne
