// Small textures for SceneBuilder scenes.
#pragma once

#include <functional>

#include "tests/support/scene_builder.h"

namespace lucarne::test {

/// Adds an image of size × size texels, value(x, y) giving RGBA, and returns a use of it.
inline TextureUse addTexture(Scene& scene, int size, const std::function<std::array<std::uint8_t, 4>(int, int)>& value,
                             bool nearest = false) {
  Image image{size, size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const std::uint8_t v : value(x, y)) image.rgba.push_back(v);
  scene.images.push_back(std::move(image));
  Texture texture;
  texture.image = static_cast<std::uint32_t>(scene.images.size() - 1);
  texture.nearest = nearest;
  scene.textures.push_back(texture);
  TextureUse use;
  use.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
  return use;
}

/// Tangents of quads whose texture coordinates SceneBuilder::addQuad() makes: along u.
inline void addTangents(Scene& scene) {
  scene.tangents.assign(scene.positions.size(), Vec4f{1, 0, 0, 1});
  for (const Triangle& t : scene.triangles) {
    const Vec2f d1 = scene.uv0[t.v[1]] - scene.uv0[t.v[0]], d2 = scene.uv0[t.v[2]] - scene.uv0[t.v[0]];
    const Vec3f e1 = scene.positions[t.v[1]] - scene.positions[t.v[0]],
                e2 = scene.positions[t.v[2]] - scene.positions[t.v[0]];
    const float det = d1.x * d2.y - d2.x * d1.y;
    if (det == 0) continue;
    const Vec3f along = normalize((e1 * d2.y - e2 * d1.y) / det);
    for (const std::uint32_t v : t.v) scene.tangents[v] = {along.x, along.y, along.z, det > 0 ? -1.f : 1.f};
  }
}

}  // namespace lucarne::test
