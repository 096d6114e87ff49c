#include "tracer/scene/gltf_materials.h"

#include <algorithm>

#include "tracer/scene/gltf_material_extensions.h"

namespace lucarne {
namespace {

constexpr double kMostNormalScale = 1e6;

/// Reads one material.
class MaterialReader {
 public:
  MaterialReader(const GltfSource& source, std::uint32_t index)
      : json_(source.list("materials")[index]),
        place_(source.place().in("materials", index)),
        textures_(source.list("textures").size()) {}

  Material read();
  const TextureUseReader& textures() const { return textures_; }
  bool clamped() const { return factors_.clamped(); }

 private:
  void readMetallicRoughness();
  void readAlphaMode();
  void readEmission();
  void readNormalMap();

  const Json& json_;
  Place place_;
  TextureUseReader textures_;
  MaterialFactors factors_;
  Material material_;
};

/// Textures in the order of what a wrong set of texture coordinates would spoil.
Material MaterialReader::read() {
  material_.name = textOf(json_, "name", "", place_);
  material_.doubleSided = flagOf(json_, "doubleSided", false, place_);
  readMetallicRoughness();
  const MaterialInput in{json_, place_, factors_, textures_};
  const bool glossy = readSpecularGlossiness(in, material_);
  readAlphaMode();
  readEmission();
  readTransmission(in, material_);
  readNormalMap();
  if (!glossy) readSpecular(in, material_);
  readUnlit(in, material_);
  return material_;
}

void MaterialReader::readMetallicRoughness() {
  const Json* pbr = findObject(json_, "pbrMetallicRoughness", place_);
  if (pbr == nullptr) return;
  const Place place = place_.in("pbrMetallicRoughness");
  const auto c = numbersOf<4>(*pbr, "baseColorFactor", {1, 1, 1, 1}, place);
  material_.baseColor = factors_.unitColor(c);
  material_.alpha = static_cast<float>(factors_.unit(c[3]));
  material_.baseColorTexture = textures_.read(*pbr, "baseColorTexture", place);
  material_.metallic = factors_.unit(*pbr, "metallicFactor", 1, place);
  material_.roughness = factors_.unit(*pbr, "roughnessFactor", 1, place);
  material_.metallicRoughnessTexture = textures_.read(*pbr, "metallicRoughnessTexture", place);
}

void MaterialReader::readAlphaMode() {
  const std::string mode = textOf(json_, "alphaMode", "OPAQUE", place_);
  const bool known = mode == "OPAQUE" || mode == "MASK" || mode == "BLEND";
  if (!known) place_.in("alphaMode").fail("is none of OPAQUE, MASK and BLEND");
  material_.alphaMode = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
  // No alpha reaches a cutoff above 1, which is legal; how far above is all the same.
  const double cutoff = std::min(numberOf(json_, "alphaCutoff", 0.5, place_), 2.0);
  material_.alphaCutoff = static_cast<float>(factors_.within(cutoff, 0, 2));
}

void MaterialReader::readEmission() {
  auto factor = numbersOf<3>(json_, "emissiveFactor", {0, 0, 0}, place_);
  const Json* strong = findExtension(json_, "KHR_materials_emissive_strength", place_);
  const double strength =
      strong == nullptr ? 1 : numberOf(*strong, "emissiveStrength", 1, place_.in("KHR_materials_emissive_strength"));
  for (double& f : factor) f *= strength;
  if (strength < 0) place_.in("emissiveStrength").fail("is negative");
  material_.emissive = openColor(factor, place_.in("emissiveFactor"));
  material_.emissiveTexture = textures_.read(json_, "emissiveTexture", place_);
}

void MaterialReader::readNormalMap() {
  material_.normalTexture = textures_.read(json_, "normalTexture", place_);
  if (!material_.normalTexture) return;
  // Negative scales are legal: they turn hills into hollows.
  const double scale = numberOf(*findObject(json_, "normalTexture", place_), "scale", 1, place_.in("normalTexture"));
  material_.normalScale = static_cast<float>(factors_.within(scale, -kMostNormalScale, kMostNormalScale));
}

/// Textures without an image in the file that a material uses: white, but for normal maps, which are dropped.
void listMissingImages(GltfMaterials& all, std::vector<std::string>& leftOut) {
  const auto missing = [&](const TextureUse& use) { return use && all.textures[use.texture].image == kNone; };
  bool flat = false, white = false;
  for (Material& m : all.materials) {
    if (missing(m.normalTexture)) {
      m.normalTexture = {};
      flat = true;
    }
    for (const TextureUse* use : textureUses(m)) white |= missing(*use);
  }
  if (white) leftOut.emplace_back("textures without a PNG or JPEG image: white stands in");
  if (flat) leftOut.emplace_back("normal maps without a PNG or JPEG image: ignored");
}

}  // namespace

std::array<const TextureUse*, 7> textureUses(const Material& m) {
  return {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture,    &m.normalTexture,
          &m.specularTexture,  &m.specularColorTexture,     &m.transmissionTexture};
}

GltfMaterials readMaterials(const GltfSource& source, std::vector<std::string>& leftOut) {
  GltfMaterials all;
  bool clamped = false;
  for (std::uint32_t i = 0; i < source.list("textures").size(); ++i) all.textures.push_back(readTexture(source, i));
  for (std::uint32_t i = 0; i < source.list("materials").size(); ++i) {
    MaterialReader reader(source, i);
    all.materials.push_back(reader.read());
    all.uvSlots.push_back(reader.textures().slots());
    clamped |= reader.clamped();
    if (reader.textures().thirdUvSet()) {
      leftOut.emplace_back("third set of texture coordinates of material " + std::to_string(i) +
                        ": its second one is used");
    }
  }
  all.materials.emplace_back().name = "default";
  all.uvSlots.push_back({0, 1});
  if (clamped) leftOut.emplace_back("material factors outside their range: brought into it");
  listMissingImages(all, leftOut);
  return all;
}

}  // namespace lucarne
