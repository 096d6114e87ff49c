// From a material and a place on it to what happens to light there.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "tracer/optics/bsdf.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/glass.h"
#include "tracer/optics/glass_table.h"
#include "tracer/optics/texture.h"
#include "tracer/optics/volume.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// A material's factors times its textures at one place. Values outside their ranges are clamped where they are used.
struct MaterialValues {
  Rgb baseColor{1.f};
  float metallic = 1, roughness = 1;
  float specular = 1;
  Rgb specularColor{1.f};
  float transmission = 0;
};
MaterialValues factorsOf(const Material& material);

/// The opaque part of a material: all of it but what transmission takes of its dielectric.
///
/// glTF mixes (1−m)·[(1−τ)·D + τ·G] + m·M: metallic m, transmission τ, D a diffuse base under a dielectric coat, G
/// glass, M metal. The share of G is t = (1−m)·τ; the rest, normalised, is the same mix of D and M with metallic
/// m/(1−t).
Bsdf makeBsdf(const Material& material, const MaterialValues& values);
/// Share t of glass.
inline float glassShare(const MaterialValues& v) {
  return std::clamp(1.f - v.metallic, 0.f, 1.f) * std::clamp(v.transmission, 0.f, 1.f);
}

/// Probability that light meets the surface where its base colour texture is read at `uv`: see
/// SurfaceTable::coverage().
float coverageOf(const Material& material, const TextureReader& baseColor, Vec2f uv, bool back);

/// What the materials of a scene's triangles ask of the tracer.
struct SceneFeatures {
  bool coats = false;     // anything but Lambert
  bool textures = false;  // of any value but the normal and the emission
  bool normalMaps = false;
  bool holes = false;  // alpha, or unlit backs
  bool transmission = false;
  friend constexpr bool operator==(const SceneFeatures&, const SceneFeatures&) = default;
};

SceneFeatures featuresOf(const Scene& scene);

/// A place on a triangle.
struct SurfacePlace {
  std::uint32_t material, triangle;
  Vec2f b;  // barycentrics (b1, b2)
};

/// The glass of a material at one place, as seen from one side.
struct GlassPart {
  float share;  // of the whole BSDF, see makeBsdf()
  Glass glass;
  const GlassTable* table;
};

/// Materials with their constant parts worked out once, so that an untextured hit costs a look.
class SurfaceTable {
 public:
  /// `scene` must outlive this.
  explicit SurfaceTable(const Scene& scene);

  /// featuresOf() the scene.
  const SceneFeatures& features() const { return features_; }

  /// The opaque part of the BSDF. `scratch` holds the answer where textures make it.
  const Bsdf& bsdf(const SurfacePlace& at, Bsdf& scratch) const {
    const Entry& entry = entries_[at.material];
    if (!entry.textured) return entry.constant;
    scratch = makeBsdf(*entry.material, values(at));
    return scratch;
  }
  /// Of materials that are known to have no textures.
  const Bsdf& constantBsdf(std::uint32_t material) const { return entries_[material].constant; }
  /// The coat of a material without textures; null where bsdf() must be asked at each place, or is Lambert.
  const Coat* coat(std::uint32_t material) const { return coats_[material] ? &*coats_[material] : nullptr; }
  MaterialValues values(const SurfacePlace& at) const;

  /// True when light is scattered on both sides: double-sided materials, and all that transmit.
  bool twoSided(std::uint32_t material) const { return entries_[material].twoSided; }
  bool transmits(std::uint32_t material) const { return entries_[material].transmits; }
  /// Of a material that transmits, seen from inside (a back) or outside.
  GlassPart glass(const SurfacePlace& at, bool inside) const;
  /// True when the surface bounds a volume: light that goes through is bent, and what is inside takes its share.
  bool solid(std::uint32_t material) const { return entries_[material].solid; }
  const Attenuation& attenuation(std::uint32_t material) const { return attenuations_[material]; }
  bool hasNormalMap(std::uint32_t material) const { return entries_[material].normalMap; }
  /// True where light may go straight through: coverage() is below 1 somewhere.
  bool hasHoles(std::uint32_t material) const { return entries_[material].holes; }
  /// Probability that light meets a surface here: alpha, cut off for masks. The back of one-sided unlit surfaces is
  /// not there for light, so that a painted sky does not keep the sun out.
  float coverage(const SurfacePlace& at, bool back) const;

  /// Radiance of the surface where it covers, in cd/m², on each side that emits.
  Rgb emittedRadiance(const SurfacePlace& at) const;
  /// Emitted radiance times coverage: what leaves the triangle on average.
  Rgb emission(std::uint32_t triangle, Vec2f b) const;
  /// The normal map's vector in tangent space, scaled, not normalised.
  Vec3f mapNormal(const SurfacePlace& at) const;

 private:
  struct alignas(64) Entry {  // one cache line a material
    Bsdf constant;
    const Material* material = nullptr;
    bool textured = false, twoSided = false, transmits = false, solid = false, normalMap = false, holes = false;
  };
  struct Readers {
    TextureReader baseColor, metallicRoughness, specular, specularColor, transmission, normal, emissive;
    bool any() const {
      return baseColor || metallicRoughness || specular || specularColor || transmission || normal || emissive;
    }
  };
  void addGlass(const Material& material, const Readers& readers);
  void addMaterial(const Material& material);
  void collectCorners();
  Vec2f uv(const TextureReader& texture, std::uint32_t triangle, Vec2f b) const;
  Rgb read(const TextureReader& texture, const SurfacePlace& at) const {
    return texture ? texture.rgb(uv(texture, at.triangle, at.b)) : Rgb(1.f);
  }

  const Scene* scene_;
  std::vector<Entry> entries_;
  std::vector<Readers> readers_;                                // by material
  std::vector<std::optional<Coat>> coats_;                      // by material
  std::vector<std::shared_ptr<const GlassTable>> glassTables_;  // by material; null: transmits nothing
  std::vector<Attenuation> attenuations_;                       // by material
  // Texture coordinates by set and triangle, side by side: one cache miss instead of four. Empty where nothing is
  // textured.
  using Corners = std::array<Vec2f, 3>;
  std::array<std::vector<Corners>, 2> corners_;
  SceneFeatures features_;
};

}  // namespace lucarne
