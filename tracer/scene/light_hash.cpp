#include "tracer/scene/light_hash.h"

#include <array>
#include <span>
#include <type_traits>

namespace lucarne {
namespace {

/// Numbers one after the other, so that no padding is hashed.
class NumberHasher {
 public:
  template <class... T>
  void add(T... values) {
    static_assert((std::is_arithmetic_v<T> && ...));
    (hasher_.add(std::as_bytes(std::span(&values, 1))), ...);
  }
  template <class T>
  void addVec(Vec3<T> v) {
    add(v.x, v.y, v.z);
  }
  void addVec(Vec2f v) { add(v.x, v.y); }
  /// Of types without padding.
  template <class T>
  void addAll(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(std::uint64_t{values.size()});
    hasher_.add(std::as_bytes(std::span(values)));
  }
  void addHash(const Hash128& hash) { add(hash.hi, hash.lo); }
  Hash128 finish() const { return hasher_.finish(); }

 private:
  Hasher hasher_;
};

Hash128 imageHash(const Image& image) {
  NumberHasher h;
  h.add(image.width, image.height);
  h.addAll(image.rgba);
  return h.finish();
}

void addTexture(const Scene& scene, const std::vector<Hash128>& images, const TextureUse& use, NumberHasher& h) {
  h.add(bool(use));
  if (!use) return;
  const Texture& texture = scene.textures[use.texture];
  h.add(static_cast<int>(texture.wrapS), static_cast<int>(texture.wrapT), texture.nearest, use.uvSet);
  for (const Vec2f v : {use.rowU, use.rowV, use.offset}) h.addVec(v);
  h.add(texture.image != kNone);
  if (texture.image != kNone) h.addHash(images[texture.image]);
}

std::array<TextureUse, 7> texturesOf(const Material& m) {
  return {m.baseColorTexture, m.metallicRoughnessTexture, m.emissiveTexture,    m.normalTexture,
          m.specularTexture,  m.specularColorTexture,     m.transmissionTexture};
}

void addMaterial(const Scene& scene, const std::vector<Hash128>& images, const Material& m, NumberHasher& h) {
  for (const Rgb v : {m.baseColor, m.emissive, m.specularColor, m.attenuationColor}) h.addVec(v);
  h.add(static_cast<int>(m.alphaMode), m.alpha, m.alphaCutoff, m.unlit, m.metallic, m.roughness, m.normalScale,
        m.specular, m.ior, m.transmission, m.solid, m.attenuationDistance, m.doubleSided);
  for (const TextureUse& use : texturesOf(m)) addTexture(scene, images, use, h);
}

std::vector<Hash128> imageHashes(const Scene& scene) {
  std::vector<Hash128> hashes;
  for (const Image& image : scene.images) hashes.push_back(imageHash(image));
  return hashes;
}

std::vector<std::uint8_t> usedMaterials(const Scene& scene) {
  std::vector<std::uint8_t> used(scene.materials.size(), 0);
  for (const Triangle& t : scene.triangles) used[t.material] = 1;
  return used;
}

void addGeometry(const Scene& scene, NumberHasher& h) {
  h.addVec(scene.frame.origin);
  h.add(scene.frame.scale);
  h.addAll(scene.positions);
  h.addAll(scene.normals);
  for (const std::vector<Vec2f>* uv : {&scene.uv0, &scene.uv1, &scene.atlasUv}) h.addAll(*uv);
  h.addAll(scene.tangents);
  h.addAll(scene.triangles);
  h.addAll(scene.smooth);
  h.addAll(scene.skipped);
  h.addAll(scene.chartOfTriangle);
  h.add(std::uint64_t{scene.instances.size()});
  for (const PrimitiveInstance& i : scene.instances)
    h.add(i.firstTriangle, i.triangleCount, i.firstVertex, i.vertexCount, i.texelsPerMetre);
}

}  // namespace

Hash128 lightHash(const Light& light) {
  NumberHasher h;
  h.add(static_cast<int>(light.kind), light.cosInner, light.cosOuter);
  h.addVec(light.intensity);
  h.addVec(light.position);
  h.addVec(light.direction);
  return h.finish();
}

Hash128 lightHash(const Scene& scene, const Material& material) {
  std::vector<Hash128> images(scene.images.size());
  for (const TextureUse& use : texturesOf(material)) {
    if (!use) continue;
    const std::uint32_t image = scene.textures[use.texture].image;
    if (image != kNone) images[image] = imageHash(scene.images[image]);
  }
  NumberHasher h;
  addMaterial(scene, images, material, h);
  return h.finish();
}

Hash128 lightHash(const Scene& scene) {
  NumberHasher h;
  addGeometry(scene, h);
  const std::vector<Hash128> images = imageHashes(scene);
  const std::vector<std::uint8_t> used = usedMaterials(scene);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    h.add(std::uint64_t{i});
    addMaterial(scene, images, scene.materials[i], h);
  }
  for (const Light& light : scene.lights) h.addHash(lightHash(light));
  return h.finish();
}

}  // namespace lucarne
