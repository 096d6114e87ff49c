#include "app/scene_difference.h"

#include <algorithm>

#include "app/check_input.h"
#include "app/mesh_difference.h"
#include "app/named_pairs.h"
#include "app/unpaired.h"
#include "app/used_materials.h"
#include "base/units.h"
#include "tracer/scene/light_hash.h"

namespace lucarne {
namespace {

using List = std::vector<std::string>;

std::string text(double value) { return formatNumber(value); }
std::string text(float value) { return formatNumber(static_cast<double>(value)); }
std::string text(bool value) { return value ? "yes" : "no"; }
template <class T>
std::string text(Vec3<T> v) {
  if (v.x == v.y && v.y == v.z) return text(v.x);
  std::string all = "(";
  all.append(text(v.x)).append(", ").append(text(v.y)).append(", ").append(text(v.z));
  return all.append(")");
}

/// Collects what two things of one name differ in.
class Differences {
 public:
  Differences(std::string what, List& list) : what_(std::move(what)), list_(list) {}
  template <class T>
  void compare(const char* member, const T& a, const T& b, const char* unit = "") {
    if (!(a != b)) return;
    const std::string from = text(a), to = text(b);
    add(std::string(member) + (from == to ? " differs slightly" : " " + from + " → " + to + unit));
  }
  void add(const std::string& how) {
    list_.push_back(what_ + ": " + how);
    any_ = true;
  }
  bool any() const { return any_; }

 private:
  std::string what_;
  List& list_;
  bool any_ = false;
};

const char* nameOf(LightKind kind) {
  constexpr const char* kNames[] = {"point", "spot", "directional"};
  return kNames[static_cast<int>(kind)];
}

/// Local numbers mean something only in their frame; rounding to it is no difference.
bool apart(Vec3d a, Vec3d b, double scale) { return length(a - b) > 1e-6 * scale; }

void compareLights(const Scene& a, const Scene& b, const Light& l, const Light& m, List& list) {
  Differences d("light " + quotedName(l.name), list);
  if (l.kind != m.kind) d.add(std::string("kind ") + nameOf(l.kind) + " → " + nameOf(m.kind));
  d.compare("intensity", l.intensity, m.intensity, m.kind == LightKind::directional ? " lx" : " cd");
  if (l.kind != LightKind::directional &&
      apart(a.frame.toWorld(l.position), b.frame.toWorld(m.position), a.frame.scale))
    d.add("moved");
  if (l.kind != LightKind::point && l.direction != m.direction) d.add("turned");
  if (l.kind == LightKind::spot && m.kind == LightKind::spot && (l.cosInner != m.cosInner || l.cosOuter != m.cosOuter))
    d.add("its cone differs");
}

struct MaterialTexture {
  const char* name;
  TextureUse Material::*use;
};

constexpr MaterialTexture kTextures[] = {{"base colour texture", &Material::baseColorTexture},
                                         {"roughness texture", &Material::metallicRoughnessTexture},
                                         {"emissive texture", &Material::emissiveTexture},
                                         {"normal map", &Material::normalTexture},
                                         {"specular texture", &Material::specularTexture},
                                         {"specular colour texture", &Material::specularColorTexture},
                                         {"transmission texture", &Material::transmissionTexture}};

/// A material that has nothing but one texture, so that its hash is that texture's.
Hash128 textureHash(const Scene& scene, const TextureUse& use) {
  Material plain;
  plain.baseColorTexture = use;
  return lightHash(scene, plain);
}

void compareMaterials(const Scene& a, const Scene& b, const Material& m, const Material& n, List& list) {
  if (lightHash(a, m) == lightHash(b, n)) return;
  Differences d("material " + quotedName(m.name), list);
  d.compare("base colour", m.baseColor, n.baseColor);
  d.compare("emissive", m.emissive, n.emissive, " cd/m²");
  d.compare("metallic", m.metallic, n.metallic);
  d.compare("roughness", m.roughness, n.roughness);
  d.compare("specular", m.specular, n.specular);
  d.compare("specular colour", m.specularColor, n.specularColor);
  d.compare("alpha", m.alpha, n.alpha);
  d.compare("alpha cutoff", m.alphaCutoff, n.alphaCutoff);
  d.compare("ior", m.ior, n.ior);
  d.compare("transmission", m.transmission, n.transmission);
  d.compare("attenuation colour", m.attenuationColor, n.attenuationColor);
  d.compare("attenuation distance", m.attenuationDistance, n.attenuationDistance, " m");
  d.compare("normal scale", m.normalScale, n.normalScale);
  d.compare("double-sided", m.doubleSided, n.doubleSided);
  d.compare("unlit", m.unlit, n.unlit);
  d.compare("volume", m.solid, n.solid);
  if (m.alphaMode != n.alphaMode) d.add("alpha mode differs");
  for (const MaterialTexture& t : kTextures) {
    const TextureUse &u = m.*(t.use), &v = n.*(t.use);
    if (bool(u) != bool(v)) {
      d.add(std::string(t.name) + (u ? " is gone" : " is new"));
    } else if (u && textureHash(a, u) != textureHash(b, v)) {
      d.add(std::string(t.name) + " differs");
    }
  }
  if (!d.any()) d.add("differs");
}

std::vector<const Light*> lightsOf(const Scene& scene) {
  std::vector<const Light*> list;
  for (const Light& l : scene.lights) list.push_back(&l);
  return list;
}

}  // namespace

List sceneDifferences(const Scene& before, const Scene& after) {
  if (lightHash(before) == lightHash(after)) return {};
  List list;
  Unpaired<Light> lights;
  forNamedPairs(lightsOf(before), lightsOf(after), [&](const Light* l, const Light* m) {
    if (l != nullptr && m != nullptr) return compareLights(before, after, *l, *m, list);
    lights.add(l, m);
  });
  lights.tell(
      "light", [](const Light& l, const Light& m) { return lightHash(l) == lightHash(m); }, list);
  Unpaired<Material> materials;
  forNamedPairs(usedMaterials(before), usedMaterials(after), [&](const Material* m, const Material* n) {
    if (m != nullptr && n != nullptr) return compareMaterials(before, after, *m, *n, list);
    materials.add(m, n);
  });
  materials.tell(
      "material", [&](const Material& m, const Material& n) { return lightHash(before, m) == lightHash(after, n); },
      list);
  addMeshDifferences(before, after, list);
  if (list.empty()) list.emplace_back("the order of triangles, materials or lights");
  return list;
}

std::string someOf(const List& differences) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, differences.size()); ++i)
    text += (text.empty() ? "" : "; ") + differences[i];
  return differences.size() > kMost ? text + "; and " + std::to_string(differences.size() - kMost) + " more" : text;
}

}  // namespace lucarne
