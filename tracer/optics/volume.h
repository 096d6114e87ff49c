// What a clear volume takes from light on its way (KHR_materials_volume): Beer's law, T(d) = exp(−σ d).
#pragma once

#include <algorithm>
#include <limits>

#include "base/math.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Absorption of a medium. The file names the colour c that white light keeps after a distance D: σ = −ln(c) / D.
struct Attenuation {
  Rgbd sigma{};  // per metre, ≥ 0; infinite where the colour is 0: black after any way at all

  Attenuation() = default;
  explicit Attenuation(const Material& m) {
    if (!(m.attenuationDistance > 0)) return;  // 0: a clear volume
    for (int i = 0; i < 3; ++i) {
      const auto c = static_cast<double>(m.attenuationColor[i]);
      sigma[i] = c > 0 ? std::max(0.0, -log(c)) / m.attenuationDistance : std::numeric_limits<double>::infinity();
    }
  }

  bool clear() const { return maxComponent(sigma) <= 0; }
  /// Share left after a way in metres. 1 where the way is not positive.
  Rgb over(double metres) const {
    if (!(metres > 0)) return Rgb{1.f};
    const auto left = [&](double s) {
      const double depth = s * metres;
      return depth < 700 ? static_cast<float>(exp(-depth)) : 0.f;
    };
    return {left(sigma.x), left(sigma.y), left(sigma.z)};
  }
};

/// attenuationColor^(metres / attenuationDistance); 1 for a clear volume.
inline Rgb transmittance(const Material& material, double metres) { return Attenuation(material).over(metres); }

}  // namespace lucarne
