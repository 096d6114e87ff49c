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

Json materialJson(const Material& m) {
  Json json = {{"doubleSided", m.doubleSided}};
  if (!m.name.empty()) json["name"] = m.name;
  Json& pbr = json["pbrMetallicRoughness"];
  pbr["baseColorFactor"] = {m.baseColor.x, m.baseColor.y, m.baseColor.z, 1};
  pbr["metallicFactor"] = m.metallic;
  pbr["roughnessFactor"] = m.roughness;
  if (m.baseColorTexture) pbr["baseColorTexture"] = textureJson(m.baseColorTexture);
  if (m.metallicRoughnessTexture) pbr["metallicRoughnessTexture"] = textureJson(m.metallicRoughnessTexture);
  if (m.emits()) json["emissiveFactor"] = colorJson(m.emissive);
  if (m.emissiveTexture) json["emissiveTexture"] = textureJson(m.emissiveTexture);
  Json& extensions = json["extensions"];
  extensions["KHR_materials_ior"]["ior"] = m.ior;
  extensions["KHR_materials_specular"] = {{"specularFactor", m.specular},
                                          {"specularColorFactor", colorJson(m.specularColor)}};
  return json;
}

Json samplerJson(const Texture& t) {
  const auto wrap = [](Wrap w) { return w == Wrap::repeat ? 10497 : w == Wrap::clampToEdge ? 33071 : 33648; };
  return {{"wrapS", wrap(t.wrapS)}, {"wrapT", wrap(t.wrapT)}, {"magFilter", t.nearest ? 9728 : 9729}};
}

}  // namespace

void putMaterials(const Scene& scene, Json& json) {
  json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_specular"};
  for (const Material& m : scene.materials) json["materials"].push_back(materialJson(m));
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    json["samplers"].push_back(samplerJson(scene.textures[i]));
    Json texture = {{"sampler", i}};
    if (scene.textures[i].image != kNone) texture["source"] = scene.textures[i].image;
    json["textures"].push_back(texture);
  }
  for (std::size_t i = 0; i < scene.images.size(); ++i)
    json["images"].push_back({{"uri", "image" + std::to_string(i) + ".png"}});
  if (json["materials"].dump().find("KHR_texture_transform") != std::string::npos) {
    json["extensionsUsed"].push_back("KHR_texture_transform");
  }
}

}  // namespace lucarne
