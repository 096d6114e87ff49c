#include "tracer/scene/gltf_material_extensions.h"

namespace lucarne {
namespace {

constexpr double kLeastDistance = 1e-30, kInfiniteDistance = 1e30;  // metres

/// Metres; 0 for what does not attenuate: the absent distance is infinite, and 0 stands for that in many files.
double attenuationDistance(const Json& volume, const Place& place, MaterialFactors& factors) {
  const double metres = numberOf(volume, "attenuationDistance", kInfiniteDistance, place);
  if (metres >= kInfiniteDistance || metres == 0) return 0;
  return metres < 0 ? factors.within(metres, 0, kInfiniteDistance)
                    : factors.within(metres, kLeastDistance, kInfiniteDistance);
}

void readVolume(const MaterialInput& in, Material& material) {
  const Json* volume = findExtension(in.json, "KHR_materials_volume", in.place);
  if (volume == nullptr) return;
  const Place place = in.place.in("KHR_materials_volume");
  const double thickness = numberOf(*volume, "thicknessFactor", 0, place);
  const double distance = attenuationDistance(*volume, place, in.factors);
  const Rgb color = in.factors.unitColor(numbersOf<3>(*volume, "attenuationColor", {1, 1, 1}, place));
  if (in.factors.within(thickness, 0, 1e300) == 0) return;
  material.solid = true;
  material.attenuationColor = color;
  material.attenuationDistance = distance;
}

}  // namespace

bool readSpecularGlossiness(const MaterialInput& in, Material& material) {
  const Json* gloss = findExtension(in.json, "KHR_materials_pbrSpecularGlossiness", in.place);
  if (gloss == nullptr) return false;
  const Place place = in.place.in("KHR_materials_pbrSpecularGlossiness");
  const auto diffuse = numbersOf<4>(*gloss, "diffuseFactor", {1, 1, 1, 1}, place);
  material.baseColor = in.factors.unitColor(diffuse);
  material.alpha = static_cast<float>(in.factors.unit(diffuse[3]));
  material.baseColorTexture = in.textures.read(*gloss, "diffuseTexture", place);
  material.metallic = 0;
  material.roughness = static_cast<float>(1 - in.factors.unit(numberOf(*gloss, "glossinessFactor", 1, place)));
  material.metallicRoughnessTexture = {};
  if (findMember(*gloss, "specularGlossinessTexture") != nullptr) return true;
  const auto specular = numbersOf<3>(*gloss, "specularFactor", {1, 1, 1}, place);
  const Rgbd reflectance{in.factors.unit(specular[0]), in.factors.unit(specular[1]), in.factors.unit(specular[2])};
  material.specularColor = Rgb(reflectance / 0.04);
  return true;
}

void readSpecular(const MaterialInput& in, Material& material) {
  const Json* specular = findExtension(in.json, "KHR_materials_specular", in.place);
  if (specular != nullptr) {
    const Place place = in.place.in("KHR_materials_specular");
    material.specular = in.factors.unit(*specular, "specularFactor", 1, place);
    material.specularTexture = in.textures.read(*specular, "specularTexture", place);
    material.specularColor =
        openColor(numbersOf<3>(*specular, "specularColorFactor", {1, 1, 1}, place), place.in("specularColorFactor"));
    material.specularColorTexture = in.textures.read(*specular, "specularColorTexture", place);
  }
  const Json* refraction = findExtension(in.json, "KHR_materials_ior", in.place);
  if (refraction == nullptr) return;
  const double ior = numberOf(*refraction, "ior", 1.5, in.place.in("KHR_materials_ior"));
  // 0 stands for an infinite index (full reflection); nothing else below 1 exists.
  material.ior = static_cast<float>(ior == 0 ? 0 : in.factors.within(ior, 1, 1e6));
}

void readTransmission(const MaterialInput& in, Material& material) {
  const Json* transmission = findExtension(in.json, "KHR_materials_transmission", in.place);
  if (transmission == nullptr) return;
  const Place place = in.place.in("KHR_materials_transmission");
  material.transmission = in.factors.unit(*transmission, "transmissionFactor", 0, place);
  material.transmissionTexture = in.textures.read(*transmission, "transmissionTexture", place);
  if (material.transmission > 0) readVolume(in, material);
}

void readUnlit(const MaterialInput& in, Material& material) {
  material.unlit = findExtension(in.json, "KHR_materials_unlit", in.place) != nullptr;
}

}  // namespace lucarne
