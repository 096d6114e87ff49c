#include "dlm/needs.h"

#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne {

Need needOf(const Material& material) {
  if (material.unlit) return Need::nothing;
  constexpr float kWidestExponent = 0.5f;
  // Textures only lower metallic and roughness; the coat at its strongest and sharpest decides.
  const Bsdf bsdf = makeBsdf(material, factorsOf(material));
  if (bsdf.lambert()) return Need::irradiance;
  if (material.metallicRoughnessTexture) return Need::directions;
  return phongFromAlpha(bsdf.alpha) < kWidestExponent ? Need::irradiance : Need::directions;
}

}  // namespace lucarne
