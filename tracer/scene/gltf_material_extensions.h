// Material extensions of glTF that the tracer models: what they say goes into a Material.
#pragma once

#include "tracer/scene/gltf_material_factors.h"
#include "tracer/scene/gltf_textures.h"

namespace lucarne {

/// A material's JSON and what the reading of it shares.
struct MaterialInput {
  const Json& json;
  const Place& place;
  MaterialFactors& factors;
  TextureUseReader& textures;
};

/// KHR_materials_pbrSpecularGlossiness as diffuse colour over a dielectric of the named reflectance at normal
/// incidence: with ior 1.5 that is 0.04 · specularColor. A texture of the reflectance is not read, and then the usual
/// 0.04 is a better guess than the factor alone. False where the material has none.
bool readSpecularGlossiness(const MaterialInput& in, Material& material);

/// KHR_materials_specular and KHR_materials_ior.
void readSpecular(const MaterialInput& in, Material& material);

/// KHR_materials_transmission and, of materials that transmit, KHR_materials_volume. The thickness says only whether
/// there is a volume: light runs through the geometry itself.
void readTransmission(const MaterialInput& in, Material& material);

/// KHR_materials_unlit.
void readUnlit(const MaterialInput& in, Material& material);

}  // namespace lucarne
