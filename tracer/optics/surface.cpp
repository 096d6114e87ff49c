#include "tracer/optics/surface.h"

#include <algorithm>

#include "tracer/optics/ggx.h"
#include "tracer/optics/texture.h"

namespace lucarne {
namespace {

Rgb clampUnit(Rgb c) { return {std::clamp(c.x, 0.f, 1.f), std::clamp(c.y, 0.f, 1.f), std::clamp(c.z, 0.f, 1.f)}; }
Rgb mix(Rgb a, Rgb b, float t) { return a * (1 - t) + b * t; }

}  // namespace

Bsdf makeBsdf(const Material& material, Rgb baseColor, float metallic, float roughness) {
  metallic = std::clamp(metallic, 0.f, 1.f);
  roughness = std::clamp(roughness, 0.f, 1.f);
  baseColor = clampUnit(baseColor);
  const float specular = std::clamp(material.specular, 0.f, 1.f);
  const float r = (material.ior - 1) / (material.ior + 1);
  const Rgb dielectric = clampUnit(material.specularColor * (r * r)) * specular;
  Bsdf bsdf;
  bsdf.diffuse = baseColor * (1 - metallic);
  bsdf.f0 = mix(dielectric, baseColor, metallic);
  bsdf.f90 = Rgb(specular * (1 - metallic) + metallic);
  bsdf.alpha = std::max(roughness * roughness, kMinAlpha);
  return bsdf;
}

SurfaceTable::SurfaceTable(const Scene& scene) : scene_(&scene) {
  for (const Material& m : scene.materials) {
    entries_.push_back({makeBsdf(m, m.baseColor, m.metallic, m.roughness),
                        bool(m.baseColorTexture) || bool(m.metallicRoughnessTexture), m.doubleSided});
    const Entry& entry = entries_.back();
    coats_.emplace_back();
    if (!entry.textured && !entry.constant.lambert()) coats_.back().emplace(entry.constant);
  }
  const bool textured = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
    return m.baseColorTexture || m.metallicRoughnessTexture || m.emissiveTexture;
  });
  if (!textured) return;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const std::vector<Vec2f>& set = i == 0 ? scene.uv0 : scene.uv1;
    if (set.empty()) continue;
    for (const Triangle& t : scene.triangles) corners_[i].push_back({set[t.v[0]], set[t.v[1]], set[t.v[2]]});
  }
}

Vec2f SurfaceTable::uv(const TextureUse& use, std::uint32_t triangle, Vec2f b) const {
  const std::vector<Corners>& set = corners_[use.uvSet == 0 ? 0 : 1];
  if (set.empty()) return {};
  const Corners& c = set[triangle];
  return c[0] * (1 - b.x - b.y) + c[1] * b.x + c[2] * b.y;
}

Bsdf SurfaceTable::textured(std::uint32_t material, std::uint32_t triangle, Vec2f b) const {
  const Material& m = scene_->materials[material];
  const auto value = [&](const TextureUse& use, Encoding encoding) {
    return use ? lookUp(*scene_, use, uv(use, triangle, b), encoding) : Rgb(1.f);
  };
  const Rgb base = m.baseColor * value(m.baseColorTexture, Encoding::srgb);
  const Rgb mr = value(m.metallicRoughnessTexture, Encoding::linear);
  return makeBsdf(m, base, m.metallic * mr.z, m.roughness * mr.y);
}

Rgb SurfaceTable::emission(std::uint32_t triangle, Vec2f b) const {
  const Material& m = scene_->materials[scene_->triangles[triangle].material];
  if (!m.emissiveTexture) return m.emissive;
  return m.emissive * lookUp(*scene_, m.emissiveTexture, uv(m.emissiveTexture, triangle, b), Encoding::srgb);
}

}  // namespace lucarne
