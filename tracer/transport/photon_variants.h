// The tracing loop is compiled in a few variants: a scene pays only for the features that it has.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "tracer/optics/surface.h"

namespace lucarne {

struct PhotonVariant {
  const char* name;
  SceneFeatures features;
};

/// From the leanest to the one that does everything.
inline constexpr std::array<PhotonVariant, 8> kPhotonVariants = {{
    {"diffuse", {}},
    {"coated", {.coats = true}},
    {"textured", {.coats = true, .textures = true}},
    {"glass", {.coats = true, .transmission = true}},
    {"textured with alpha", {.coats = true, .textures = true, .holes = true}},
    {"textured with normal maps", {.coats = true, .textures = true, .normalMaps = true}},
    {"textured with normal maps and alpha", {.coats = true, .textures = true, .normalMaps = true, .holes = true}},
    {"general", {.coats = true, .textures = true, .normalMaps = true, .holes = true, .transmission = true}},
}};
inline constexpr std::size_t kGeneralVariant = kPhotonVariants.size() - 1;

constexpr bool covers(const SceneFeatures& has, const SceneFeatures& needs) {
  return has.coats >= needs.coats && has.textures >= needs.textures && has.normalMaps >= needs.normalMaps &&
         has.holes >= needs.holes && has.transmission >= needs.transmission;
}

/// The leanest variant that does what a scene needs.
constexpr std::size_t photonVariantFor(const SceneFeatures& needs) {
  std::size_t i = 0;
  while (i < kGeneralVariant && !covers(kPhotonVariants[i].features, needs)) ++i;
  return i;
}

/// Calls f.operator()<features>() for variant `index`.
template <class F>
void withPhotonVariant(std::size_t index, F&& f) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((i == index ? f.template operator()<kPhotonVariants[i].features>() : void()), ...);
  }
  (std::make_index_sequence<kPhotonVariants.size()>{});
}

}  // namespace lucarne
