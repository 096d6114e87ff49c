#include "tracer/scene/gltf_plain_materials.h"

#include <cmath>

#include "base/math.h"

namespace lucarne {
namespace {

Json colorJson(Rgb c) { return Json::array({c.x, c.y, c.z}); }

Json textureJson(const TextureUse& use) {
  Json info = {{"index", use.texture}};
  if (use.uvSet != 0) info["texCoord"] = use.uvSet;
  if (use.rowU == Vec2f{1, 0} && use.rowV == Vec2f{0, 1} && use.offset == Vec2f{}) return info;
  // rowU = (c·sx, s·sy), rowV = (−s·sx, c·sy): the map of KHR_texture_transform.
  const Vec2d u{use.rowU.x, use.rowU.y}, v{use.rowV.x, use.rowV.y};
  const double sx = std::sqrt(u.x * u.x + v.x * v.x);
  Json& transform = info["extensions"]["KHR_texture_transform"];
  transform["offset"] = {use.offset.x, use.offset.y};
  transform["scale"] = {sx, sx > 0 ? (u.x * v.y - u.y * v.x) / sx : std::sqrt(u.y * u.y + v.y * v.y)};
  transform["rotation"] = atan2(-v.x, u.x);
  return info;
}

void putTexture(Json& object, const char* key, const TextureUse& use) {
  if (use) object[key] = textureJson(use);
}

void putAlpha(const Material& m, Json& json) {
  if (m.alphaMode == AlphaMode::opaque) return;
  json["alphaMode"] = m.alphaMode == AlphaMode::mask ? "MASK" : "BLEND";
  if (m.alphaMode == AlphaMode::mask) json["alphaCutoff"] = m.alphaCutoff;
}

void putTransmission(const Material& m, Json& extensions) {
  if (m.transmission <= 0) return;
  Json& transmission = extensions["KHR_materials_transmission"];
  transmission["transmissionFactor"] = m.transmission;
  putTexture(transmission, "transmissionTexture", m.transmissionTexture);
  if (!m.solid) return;
  Json& volume = extensions["KHR_materials_volume"];
  volume["thicknessFactor"] = 1;
  volume["attenuationColor"] = colorJson(m.attenuationColor);
  if (m.attenuationDistance > 0) volume["attenuationDistance"] = m.attenuationDistance;
}

Json extensionsJson(const Material& m) {
  Json extensions;
  extensions["KHR_materials_ior"]["ior"] = m.ior;
  Json& specular = extensions["KHR_materials_specular"];
  specular = {{"specularFactor", m.specular}, {"specularColorFactor", colorJson(m.specularColor)}};
  putTexture(specular, "specularTexture", m.specularTexture);
  putTexture(specular, "specularColorTexture", m.specularColorTexture);
  putTransmission(m, extensions);
  if (m.unlit) extensions["KHR_materials_unlit"] = Json::object();
  return extensions;
}

Json materialJson(const Material& m) {
  Json json = {{"doubleSided", m.doubleSided}};
  if (!m.name.empty()) json["name"] = m.name;
  Json& pbr = json["pbrMetallicRoughness"];
  pbr["baseColorFactor"] = {m.baseColor.x, m.baseColor.y, m.baseColor.z, m.alpha};
  pbr["metallicFactor"] = m.metallic;
  pbr["roughnessFactor"] = m.roughness;
  putTexture(pbr, "baseColorTexture", m.baseColorTexture);
  putTexture(pbr, "metallicRoughnessTexture", m.metallicRoughnessTexture);
  putAlpha(m, json);
  if (maxComponent(m.emissive) > 0) json["emissiveFactor"] = colorJson(m.emissive);
  putTexture(json, "emissiveTexture", m.emissiveTexture);
  putTexture(json, "normalTexture", m.normalTexture);
  if (m.normalTexture) json["normalTexture"]["scale"] = m.normalScale;
  json["extensions"] = extensionsJson(m);
  return json;
}

void listExtensions(Json& json) {
  json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_specular"};
  const std::string text = json["materials"].dump();
  for (const char* name :
       {"KHR_materials_transmission", "KHR_materials_unlit", "KHR_materials_volume", "KHR_texture_transform"}) {
    if (text.find(name) != std::string::npos) json["extensionsUsed"].push_back(name);
  }
}

Json samplerJson(const Texture& t) {
  const auto wrap = [](Wrap w) { return w == Wrap::repeat ? 10497 : w == Wrap::clampToEdge ? 33071 : 33648; };
  return {{"wrapS", wrap(t.wrapS)}, {"wrapT", wrap(t.wrapT)}, {"magFilter", t.nearest ? 9728 : 9729}};
}

}  // namespace

void putMaterials(const Scene& scene, Json& json) {
  for (const Material& m : scene.materials) json["materials"].push_back(materialJson(m));
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    json["samplers"].push_back(samplerJson(scene.textures[i]));
    Json texture = {{"sampler", i}};
    if (scene.textures[i].image != kNone) texture["source"] = scene.textures[i].image;
    json["textures"].push_back(texture);
  }
  for (std::size_t i = 0; i < scene.images.size(); ++i)
    json["images"].push_back({{"uri", "image" + std::to_string(i) + ".png"}});
  listExtensions(json);
}

}  // namespace lucarne
