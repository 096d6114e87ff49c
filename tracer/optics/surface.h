// From a material and a place on it to the BSDF and the emission there.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracer/optics/bsdf.h"
#include "tracer/optics/coat.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The BSDF of a material from its factors times the looked-up texture values.
Bsdf makeBsdf(const Material& material, Rgb baseColor, float metallic, float roughness);

/// Materials with their constant parts worked out once, so that an untextured hit costs a copy.
class SurfaceTable {
 public:
  explicit SurfaceTable(const Scene& scene);

  /// BSDF of a material at barycentrics (b1, b2) of a triangle.
  Bsdf bsdf(std::uint32_t material, std::uint32_t triangle, Vec2f b) const {
    Bsdf scratch;
    return bsdf(material, triangle, b, scratch);
  }
  /// The same without a copy: `scratch` holds the answer where textures make it.
  const Bsdf& bsdf(std::uint32_t material, std::uint32_t triangle, Vec2f b, Bsdf& scratch) const {
    const Entry& entry = entries_[material];
    if (!entry.textured) return entry.constant;
    scratch = textured(material, triangle, b);
    return scratch;
  }
  /// The coat of a material without textures; null where bsdf() must be asked at each place, or is Lambert.
  const Coat* coat(std::uint32_t material) const { return coats_[material] ? &*coats_[material] : nullptr; }
  bool doubleSided(std::uint32_t material) const { return entries_[material].doubleSided; }
  /// Emitted radiance in cd/m² at barycentrics of a triangle, on each side that emits.
  Rgb emission(std::uint32_t triangle, Vec2f b) const;

 private:
  struct alignas(64) Entry {  // one cache line a material
    Bsdf constant;
    bool textured = false;
    bool doubleSided = false;
  };
  Bsdf textured(std::uint32_t material, std::uint32_t triangle, Vec2f b) const;
  using Corners = std::array<Vec2f, 3>;
  Vec2f uv(const TextureUse& use, std::uint32_t triangle, Vec2f b) const;

  const Scene* scene_;
  std::vector<Entry> entries_;
  std::vector<std::optional<Coat>> coats_;  // by material
  // Texture coordinates by set and triangle, side by side: one cache miss instead of four. Empty where nothing is
  // textured.
  std::array<std::vector<Corners>, 2> corners_;
};

}  // namespace lucarne
