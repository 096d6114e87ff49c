#include "app/check_features.h"

#include <array>

#include "app/bake_report.h"
#include "app/used_materials.h"
#include "base/units.h"

namespace lucarne {
namespace {

bool degenerate(const Scene& scene, std::uint32_t triangle) { return scene.scaledNormal(triangle) == Vec3d{}; }

std::array<TextureUse, 7> texturesOf(const Material& m) {
  return {m.baseColorTexture, m.metallicRoughnessTexture, m.emissiveTexture,    m.normalTexture,
          m.specularTexture,  m.specularColorTexture,     m.transmissionTexture};
}

bool transformed(const TextureUse& use) {
  const TextureUse plain;
  return use && !(use.rowU == plain.rowU && use.rowV == plain.rowV && use.offset == plain.offset);
}

template <class Is>
bool anyTexture(const Material& m, Is&& is) {
  for (const TextureUse& use : texturesOf(m))
    if (is(use)) return true;
  return false;
}

struct MaterialFeature {
  const char* name;
  bool (*has)(const Material&);
};

// Names are keys of the JSON output, too.
constexpr std::array kMaterialFeatures = {
    MaterialFeature{"emissive", [](const Material& m) { return m.emits(); }},
    MaterialFeature{"emissive texture", [](const Material& m) { return m.emits() && m.emissiveTexture; }},
    MaterialFeature{"emissive strength", [](const Material& m) { return m.emits() && maxComponent(m.emissive) > 1; }},
    MaterialFeature{"base colour texture", [](const Material& m) { return bool(m.baseColorTexture); }},
    MaterialFeature{"metallic-roughness texture", [](const Material& m) { return bool(m.metallicRoughnessTexture); }},
    MaterialFeature{"normal map", [](const Material& m) { return bool(m.normalTexture); }},
    MaterialFeature{"alpha mask", [](const Material& m) { return m.hasAlpha() && m.alphaMode == AlphaMode::mask; }},
    MaterialFeature{"alpha blend", [](const Material& m) { return m.hasAlpha() && m.alphaMode == AlphaMode::blend; }},
    MaterialFeature{"transmission", [](const Material& m) { return m.transmits(); }},
    MaterialFeature{"volume", [](const Material& m) { return m.transmits() && m.solid; }},
    MaterialFeature{"ior", [](const Material& m) { return m.ior != 1.5f; }},
    MaterialFeature{"specular",
                    [](const Material& m) {
                      return m.specular != 1 || m.specularColor != Rgb{1.f} || m.specularTexture ||
                             m.specularColorTexture;
                    }},
    MaterialFeature{"unlit", [](const Material& m) { return m.unlit; }},
    MaterialFeature{"double-sided", [](const Material& m) { return m.doubleSided; }},
    MaterialFeature{"texture transform", [](const Material& m) { return anyTexture(m, transformed); }},
    MaterialFeature{
        "second uv set",
        [](const Material& m) { return anyTexture(m, [](const TextureUse& use) { return use && use.uvSet == 1; }); }},
};

template <class Has>
std::size_t countTriangles(const Scene& scene, const Has& has) {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) count += has(t) ? 1 : 0;
  return count;
}

void add(nlohmann::json& list, const char* feature, const char* of, std::size_t count) {
  if (count > 0) list.push_back({{"feature", feature}, {"of", of}, {"count", count}});
}

Vec3d extentInMetres(const Scene& scene) {
  Box box;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) box.add(Vec3d(scene.corner(t, k)));
  return box.empty() ? Vec3d{} : box.extent() * scene.frame.scale;
}

}  // namespace

nlohmann::json checkSize(const CheckInput& input, CheckWarnings& warnings) {
  const Scene& scene = input.scene();
  const Vec3d extent = extentInMetres(scene);
  const double largest = maxComponent(extent);
  constexpr double kSmall = 0.01, kLarge = 1000;  // metres; a room in millimetres is some kilometres
  if (largest < kSmall || largest > kLarge)
    warnings.add("units",
                 "the scene is " + formatNumber(largest) + " m across: is it in other units? glTF is in metres");
  return {{"name", sceneName(input.options)},
          {"triangles", scene.triangles.size()},
          {"degenerate_triangles", countTriangles(scene, [&](auto t) { return degenerate(scene, t); })},
          {"materials", usedMaterials(scene).size()},
          {"cameras", scene.cameras.size()},
          {"extent_m", {extent.x, extent.y, extent.z}}};
}

nlohmann::json listModelled(const Scene& scene) {
  const auto material = [&](auto t) -> const Material& { return scene.materials[scene.triangles[t].material]; };
  const auto lights = [&](LightKind kind) {
    return static_cast<std::size_t>(
        std::count_if(scene.lights.begin(), scene.lights.end(), [kind](const Light& l) { return l.kind == kind; }));
  };
  nlohmann::json list = nlohmann::json::array();
  add(list, "emissive", "triangles", countTriangles(scene, [&](auto t) { return material(t).emits(); }));
  add(list, "smooth-shaded", "triangles", countTriangles(scene, [&](auto t) { return scene.smooth[t] != 0; }));
  add(list, "double-sided", "triangles", countTriangles(scene, [&](auto t) { return material(t).doubleSided; }));
  add(list, "point", "lights", lights(LightKind::point));
  add(list, "spot", "lights", lights(LightKind::spot));
  add(list, "directional", "lights", lights(LightKind::directional));
  const std::vector<const Material*> used = usedMaterials(scene);
  for (const MaterialFeature& f : kMaterialFeatures) {
    const auto has = [&f](const Material* m) { return f.has(*m); };
    add(list, f.name, "materials", static_cast<std::size_t>(std::count_if(used.begin(), used.end(), has)));
  }
  return list;
}

nlohmann::json checkUv(const Scene& scene) {
  if (scene.atlasUv.empty()) return {{"present", false}};
  constexpr float kSlack = 1e-5f;  // of exporters' rounding
  double area = 0;
  bool inside = true;
  std::size_t without = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (degenerate(scene, t)) continue;
    Vec2d corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = scene.atlasUv[scene.triangles[t].v[k]];
      corner[k] = {static_cast<double>(uv.x), static_cast<double>(uv.y)};
      inside = inside && std::min(uv.x, uv.y) >= -kSlack && std::max(uv.x, uv.y) <= 1 + kSlack;
    }
    const Vec2d a = corner[1] - corner[0], b = corner[2] - corner[0];
    const double twice = std::abs(a.x * b.y - a.y * b.x);
    area += twice / 2;
    without += twice > 0 ? 0 : 1;
  }
  return {{"present", true}, {"inside_unit_square", inside}, {"area", area}, {"triangles_without_area", without}};
}

}  // namespace lucarne
