// Rooms with one difficulty each, that maps and gather must agree on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/support/scene_builder.h"
#include "tests/support/smooth_sphere.h"
#include "tests/support/textures.h"
#include "tracer/optics/environment.h"

namespace lucarne::test {

struct TruthScene {
  std::string name;
  std::function<Scene()> make;
  std::function<std::unique_ptr<Environment>()> sky = [] { return nullptr; };
};

inline Material glossyMaterial(Rgb color, float roughness) {
  Material m = diffuseMaterial(color);
  m.specular = 1;
  m.roughness = roughness;
  return m;
}

inline Material glassMaterial(bool solid, float roughness, Rgb tint = Rgb(1.f)) {
  Material m = glossyMaterial(tint, roughness);
  m.transmission = 1;
  m.solid = solid;
  return m;
}

/// A room of 4 × 3 × 5 m with a lamp of 2 × 2 m under the ceiling.
inline SceneBuilder lampRoom(const Material& walls) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 5}, b.addMaterial(walls), true);
  const auto lamp = b.addDiffuse(Rgb(0.2f), {90, 70, 50});
  b.addQuad({1, 2.8, 1.5}, {3, 2.8, 1.5}, {3, 2.8, 3.5}, {1, 2.8, 3.5}, lamp);
  return b;
}

inline void addBlock(SceneBuilder& b, const Material& material) {
  b.addBox({1.2, 0.6, 1.4}, {2.8, 1.4, 3.4}, b.addMaterial(material), false);
}

inline Scene screenRoom(AlphaMode mode) {
  SceneBuilder b = lampRoom(diffuseMaterial(Rgb(0.6f)));
  Material m = diffuseMaterial({0.7f, 0.5f, 0.3f});
  m.doubleSided = true;
  m.alphaMode = mode;
  m.alphaCutoff = 0.4f;
  const auto index = b.addMaterial(m);
  b.addQuad({0.5, 1.5, 1}, {3.5, 1.5, 1}, {3.5, 1.5, 4}, {0.5, 1.5, 4}, index);
  Scene s = b.build();
  s.materials[index].baseColorTexture = addTexture(s, 16, [](int x, int y) {
    return std::array<std::uint8_t, 4>{255, 255, 255, static_cast<std::uint8_t>((x * 16 + y * 3) % 256)};
  });
  return s;
}

inline Scene bumpRoom() {
  SceneBuilder b = lampRoom(glossyMaterial({0.6f, 0.5f, 0.4f}, 0.4f));
  Scene s = b.build();
  s.materials[0].normalTexture = addTexture(s, 8, [](int x, int y) {
    const auto tilt = [](int i) { return static_cast<std::uint8_t>(128 + ((i % 4) - 1.5) * 45); };
    return std::array<std::uint8_t, 4>{tilt(x), tilt(y + 1), 225, 255};
  });
  addTangents(s);
  return s;
}

inline Scene paintedLampRoom() {
  SceneBuilder b = lampRoom(diffuseMaterial({0.7f, 0.6f, 0.5f}));
  Scene s = b.build();
  s.materials[1].emissiveTexture = addTexture(s, 32, [](int x, int y) {
    const bool lit = (x / 8 + y / 8) % 3 == 0;
    return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(lit ? 255 : 20), static_cast<std::uint8_t>(8 * y), 60,
                                       255};
  });
  return s;
}

inline Scene threeLights() {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 5}, b.addDiffuse({0.6f, 0.7f, 0.5f}), true);
  b.addBox({1, 0.01, 1}, {2, 1, 2}, b.addDiffuse({0.3f, 0.2f, 0.8f}), false);
  Light point;
  point.name = "bulb";
  point.intensity = {40, 30, 20};
  point.position = {3, 2.2, 3.5};
  b.addLight(point);
  Light spot = point;
  spot.kind = LightKind::spot;
  spot.position = {0.7, 2.7, 4};
  spot.direction = normalize(Vec3d{0.5, -1, -0.6});
  spot.cosInner = 0.95;
  spot.cosOuter = 0.8;
  b.addLight(spot);
  return b.build();
}

inline Scene sphereRoom() {
  SceneBuilder b = lampRoom(diffuseMaterial(Rgb(0.5f)));
  const auto ball = b.addMaterial(glossyMaterial({0.8f, 0.3f, 0.2f}, 0.5f));
  addSphere(b, {2, 1, 2.5}, 0.8, ball, 6);
  Scene s = b.build();
  smoothen(s, ball, {2, 1, 2.5});
  return s;
}

/// A room whose front wall has an opening; everything outside is dark but the sky.
inline Scene windowRoom() {
  SceneBuilder b;
  const auto walls = b.addDiffuse({0.7f, 0.7f, 0.6f});
  const double w = 4, h = 3, d = 5;
  const auto wall = [&](Vec3d p0, Vec3d p1, Vec3d p2, Vec3d p3) { b.addQuad(p0, p1, p2, p3, walls); };
  wall({0, 0, d}, {w, 0, d}, {w, 0, 0}, {0, 0, 0});  // floor
  wall({0, h, 0}, {w, h, 0}, {w, h, d}, {0, h, d});  // ceiling
  wall({0, 0, d}, {0, 0, 0}, {0, h, 0}, {0, h, d});
  wall({w, 0, 0}, {w, 0, d}, {w, h, d}, {w, h, 0});
  wall({0, 0, 0}, {w, 0, 0}, {w, h, 0}, {0, h, 0});  // back
  // front wall about the opening 1.2 … 2.8 × 1 … 2.4
  wall({w, 0, d}, {0, 0, d}, {0, 1, d}, {w, 1, d});
  wall({w, 2.4, d}, {0, 2.4, d}, {0, h, d}, {w, h, d});
  wall({1.2, 1, d}, {0, 1, d}, {0, 2.4, d}, {1.2, 2.4, d});
  wall({w, 1, d}, {2.8, 1, d}, {2.8, 2.4, d}, {w, 2.4, d});
  return b.build();
}

/// Blue above, dim below, with a small strong sun toward +z.
inline std::unique_ptr<Environment> sunnySky(float sun = 20000) {
  ImageRgb image{64, 32, {}};
  image.pixels.resize(64 * 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const float up = y < 16 ? 1.f : 0.2f;
      image.pixels[static_cast<std::size_t>(y * 64 + x)] = Rgb{20, 30, 50} * up;
    }
  image.pixels[static_cast<std::size_t>(11 * 64 + 49)] = Rgb{1.f, 0.9f, 0.7f} * sun;  // atan2(z, x) ≈ 95°, 29° high
  return std::make_unique<Environment>(std::move(image), "sunny sky");
}

inline std::vector<TruthScene> truthScenes() {
  const auto room = [](const Material& walls, const Material& block) {
    return [=] {
      SceneBuilder b = lampRoom(walls);
      addBlock(b, block);
      return b.build();
    };
  };
  const Material grey = diffuseMaterial({0.7f, 0.6f, 0.5f});
  Material metal = glossyMaterial({0.9f, 0.7f, 0.4f}, 0.3f);
  metal.metallic = 1;
  Material green = glassMaterial(true, 0.15f);
  green.attenuationColor = {0.3f, 0.9f, 0.5f};
  green.attenuationDistance = 1;
  Material half = glassMaterial(true, 0.4f, {0.9f, 0.8f, 0.6f});
  half.transmission = 0.5f;
  return {
      {"diffuse", room(grey, diffuseMaterial({0.2f, 0.4f, 0.8f}))},
      {"coated and metal", room(glossyMaterial({0.5f, 0.5f, 0.6f}, 0.35f), metal)},
      {"smooth sphere", sphereRoom},
      {"clear glass", room(grey, glassMaterial(true, 0.05f))},
      {"green half-clear glass", room(grey, green)},
      {"frosted half glass", room(grey, half)},
      {"thin panes", room(grey, glassMaterial(false, 0.2f, {0.8f, 0.9f, 1.f}))},
      {"alpha mask", [] { return screenRoom(AlphaMode::mask); }},
      {"alpha blend", [] { return screenRoom(AlphaMode::blend); }},
      {"normal maps", bumpRoom},
      {"painted lamp", paintedLampRoom},
      {"bulb and spot", threeLights},
      {"sky through a window", windowRoom, [] { return sunnySky(); }},
  };
}

}  // namespace lucarne::test
