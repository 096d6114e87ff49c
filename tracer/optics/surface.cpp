#include "tracer/optics/surface.h"

#include <algorithm>

#include "tracer/optics/ggx.h"

namespace lucarne {
namespace {

Rgb clampUnit(Rgb c) { return {std::clamp(c.x, 0.f, 1.f), std::clamp(c.y, 0.f, 1.f), std::clamp(c.z, 0.f, 1.f)}; }
float alphaOf(float roughness) {
  const float r = std::clamp(roughness, 0.f, 1.f);
  return std::max(r * r, kMinAlpha);
}
Rgb mix(Rgb a, Rgb b, float t) { return a * (1 - t) + b * t; }

}  // namespace

MaterialValues factorsOf(const Material& m) {
  return {m.baseColor, m.metallic, m.roughness, m.specular, m.specularColor, m.transmission};
}

Bsdf makeBsdf(const Material& material, const MaterialValues& v) {
  Bsdf bsdf;
  if (material.unlit) return bsdf;
  const float glass = glassShare(v);
  const float metallic = glass < 1 ? std::min(std::clamp(v.metallic, 0.f, 1.f) / (1 - glass), 1.f) : 0.f;
  const Rgb baseColor = clampUnit(v.baseColor);
  const float specular = std::clamp(v.specular, 0.f, 1.f);
  const float r = (material.ior - 1) / (material.ior + 1);
  const Rgb dielectric = clampUnit(v.specularColor * (r * r)) * specular;
  bsdf.diffuse = baseColor * (1 - metallic);
  bsdf.f0 = mix(dielectric, baseColor, metallic);
  bsdf.f90 = Rgb(specular * (1 - metallic) + metallic);
  bsdf.alpha = alphaOf(v.roughness);
  return bsdf;
}

SceneFeatures featuresOf(const Scene& scene) {
  SceneFeatures features;
  std::vector<std::uint8_t> used(scene.materials.size(), 0);
  for (const Triangle& t : scene.triangles) used[t.material] = 1;
  const auto hasImage = [&](const TextureUse& use) {
    return use && scene.textures[use.texture].image != kNone &&
           !scene.images[scene.textures[use.texture].image].rgba.empty();
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    const Material& m = scene.materials[i];
    // Textures only scale down: what the factors leave without a coat has none anywhere.
    features.coats |= !makeBsdf(m, factorsOf(m)).lambert();
    features.textures |= !m.unlit && (hasImage(m.baseColorTexture) || hasImage(m.metallicRoughnessTexture) ||
                                      hasImage(m.specularTexture) || hasImage(m.specularColorTexture) ||
                                      hasImage(m.transmissionTexture));
    features.normalMaps |= !m.unlit && hasImage(m.normalTexture) && !scene.tangents.empty();
    features.holes |= m.hasAlpha() || (m.unlit && !m.doubleSided);
    features.transmission |= m.transmits();
  }
  return features;
}

SurfaceTable::SurfaceTable(const Scene& scene) : scene_(&scene) {
  for (const Material& m : scene.materials) addMaterial(m);
  features_ = featuresOf(scene);
  collectCorners();
}

void SurfaceTable::addMaterial(const Material& m) {
  const auto reader = [this](const TextureUse& use, Encoding encoding) {
    return TextureReader(*scene_, use, encoding);
  };
  readers_.push_back({reader(m.baseColorTexture, Encoding::srgb), reader(m.metallicRoughnessTexture, Encoding::linear),
                      reader(m.specularTexture, Encoding::linear), reader(m.specularColorTexture, Encoding::srgb),
                      reader(m.transmissionTexture, Encoding::linear), reader(m.normalTexture, Encoding::linear),
                      reader(m.emissiveTexture, Encoding::srgb)});
  const Readers& r = readers_.back();
  Entry entry;
  entry.material = &m;
  entry.constant = makeBsdf(m, factorsOf(m));
  entry.textured = !m.unlit && (r.baseColor || r.metallicRoughness || r.specular || r.specularColor || r.transmission);
  entry.transmits = m.transmits();
  entry.twoSided = m.doubleSided || entry.transmits;
  entry.solid = entry.transmits && m.solid;
  entry.normalMap = bool(r.normal) && !m.unlit;
  entry.holes = m.hasAlpha() || (m.unlit && !m.doubleSided);
  entries_.push_back(entry);
  coats_.emplace_back();
  if (!entry.textured && !entry.constant.lambert()) coats_.back().emplace(entry.constant);
  addGlass(m, r);
}

/// Materials of one index share a table where roughness is textured; else each has one for its own.
void SurfaceTable::addGlass(const Material& m, const Readers& r) {
  glassTables_.emplace_back();
  attenuations_.push_back(m.transmits() && m.solid ? Attenuation(m) : Attenuation{});
  if (!m.transmits()) return;
  glassTables_.back() = r.metallicRoughness ? std::make_shared<const GlassTable>(m.ior, !m.solid)
                                            : std::make_shared<const GlassTable>(m.ior, !m.solid, alphaOf(m.roughness));
}

GlassPart SurfaceTable::glass(const SurfacePlace& at, bool inside) const {
  const Entry& entry = entries_[at.material];
  const Material& m = *entry.material;
  const MaterialValues v = entry.textured ? values(at) : factorsOf(m);
  GlassPart part;
  part.share = glassShare(v);
  part.glass.tint = clampUnit(v.baseColor);
  part.glass.reflectance = clampUnit(v.specularColor * std::clamp(v.specular, 0.f, 1.f));
  part.glass.eta = inside && entry.solid && m.ior > 0 ? 1 / m.ior : m.ior;
  part.glass.alpha = alphaOf(v.roughness);
  part.glass.thin = !entry.solid;
  part.table = glassTables_[at.material].get();
  return part;
}

void SurfaceTable::collectCorners() {
  if (std::none_of(readers_.begin(), readers_.end(), [](const Readers& r) { return r.any(); })) return;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const std::vector<Vec2f>& set = i == 0 ? scene_->uv0 : scene_->uv1;
    if (set.empty()) continue;
    corners_[i].reserve(scene_->triangles.size());
    for (const Triangle& t : scene_->triangles) corners_[i].push_back({set[t.v[0]], set[t.v[1]], set[t.v[2]]});
  }
}

Vec2f SurfaceTable::uv(const TextureReader& texture, std::uint32_t triangle, Vec2f b) const {
  const std::vector<Corners>& set = corners_[texture.uvSet() == 0 ? 0 : 1];
  if (set.empty()) return {};
  const Corners& c = set[triangle];
  return c[0] * (1 - b.x - b.y) + c[1] * b.x + c[2] * b.y;
}

MaterialValues SurfaceTable::values(const SurfacePlace& at) const {
  MaterialValues v = factorsOf(*entries_[at.material].material);
  const Readers& r = readers_[at.material];
  v.baseColor = v.baseColor * read(r.baseColor, at);
  const Rgb mr = read(r.metallicRoughness, at);
  v.metallic *= mr.z;
  v.roughness *= mr.y;
  if (r.specular) v.specular *= r.specular.alpha(uv(r.specular, at.triangle, at.b));
  v.specularColor = v.specularColor * read(r.specularColor, at);
  v.transmission *= read(r.transmission, at).x;
  return v;
}

float coverageOf(const Material& m, const TextureReader& baseColor, Vec2f uv, bool back) {
  if (m.unlit) return back && !m.doubleSided ? 0.f : 1.f;
  if (m.alphaMode == AlphaMode::opaque) return 1;
  const float alpha = m.alpha * baseColor.alpha(uv);
  if (m.alphaMode == AlphaMode::mask) return alpha < m.alphaCutoff ? 0.f : 1.f;
  return std::clamp(alpha, 0.f, 1.f);
}

float SurfaceTable::coverage(const SurfacePlace& at, bool back) const {
  const TextureReader& texture = readers_[at.material].baseColor;
  return coverageOf(*entries_[at.material].material, texture, texture ? uv(texture, at.triangle, at.b) : Vec2f{}, back);
}

Rgb SurfaceTable::emittedRadiance(const SurfacePlace& at) const {
  const Material& m = *entries_[at.material].material;
  return m.emits() ? m.emissive * read(readers_[at.material].emissive, at) : Rgb{};
}

Rgb SurfaceTable::emission(std::uint32_t triangle, Vec2f b) const {
  const SurfacePlace at{scene_->triangles[triangle].material, triangle, b};
  const Rgb radiance = emittedRadiance(at);
  return entries_[at.material].holes ? radiance * coverage(at, false) : radiance;
}

Vec3f SurfaceTable::mapNormal(const SurfacePlace& at) const {
  const Material& m = *entries_[at.material].material;
  const Rgb c = read(readers_[at.material].normal, at);
  return {(c.x * 2 - 1) * m.normalScale, (c.y * 2 - 1) * m.normalScale, c.z * 2 - 1};
}

}  // namespace lucarne
