// Normal maps, holes, blended surfaces, glass and the sky, in both renderers.
#include <cmath>
#include <numbers>

#include "player/offscreen.h"
#include "tests/player/gl_available.h"
#include "tests/player/synthetic_maps.h"
#include "tests/support/textures.h"
#include "tracer/optics/environment.h"

namespace lucarne::surfaces_test {
namespace {

using test::BakedScene;

class Surfaces : public test::GlTest {};

constexpr RendererKind kBoth[] = {RendererKind::singlepass, RendererKind::multipass};

ImageRgb render(const BakedScene& baked, RendererKind kind, int width = 33, int height = 25,
                const ImageRgb* sky = nullptr) {
  return renderImage(baked.scene, baked.maps, baked.scene.cameras.at(0), {width, height, kind, LightMapFormat::float32},
                     nullptr, sky);
}

const Rgb& centre(const ImageRgb& image) {
  return image.pixels[static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2)];
}

Material glowing(Rgb emission) {
  Material m = test::diffuseMaterial(Rgb(0.f), emission);
  m.doubleSided = true;
  return m;
}

/// A square of side 2·half at depth z, front toward +z.
void addPane(test::BakedSceneBuilder& b, double z, double half, const Material& m,
             test::SideSpec front = {false, false, 0}) {
  b.addQuad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}, b.addMaterial(m), 4, 4, front);
}

/// A glossy plate under a normal map of one vector, `tilt` toward +x.
BakedScene tilted(double tilt, const test::IncidentRadiance& light, Material m, int directions = 64) {
  m.normalTexture.texture = 0;
  test::BakedSceneBuilder b(directions, light);
  addPane(b, 0, 1, m, {true, true, 0});
  b.addCamera({0, 0, 3}, {0, 0, 0}, 0.4);
  BakedScene baked = b.build();
  const auto code = [](double v) { return static_cast<std::uint8_t>(std::lround((v + 1) / 2 * 255)); };
  test::addTexture(baked.scene, 1, [&](int, int) {
    return std::array<std::uint8_t, 4>{code(std::sin(tilt)), code(0), code(std::cos(tilt)), 255};
  });
  test::addTangents(baked.scene);
  return baked;
}

TEST_F(Surfaces, ConstantLightIsTheSameUnderAnyNormalMap) {
  for (const double tilt : {0.0, 0.3, 0.7}) {
    const BakedScene baked = tilted(tilt, test::constantRadiance(Rgb(3.f)), test::diffuseMaterial(Rgb(0.5f)));
    for (const RendererKind kind : kBoth) EXPECT_NEAR(centre(render(baked, kind)).x, 1.5f, 0.01f) << tilt;
  }
}

TEST_F(Surfaces, NormalMapsTurnTowardTheLightOrAwayFromIt) {
  const auto fromTheRight = [](Vec3d, Vec3d d) { return Rgb(d.x > 0.3 ? 10.f : 0.1f); };
  const auto brightness = [&](double tilt, RendererKind kind) {
    return centre(render(tilted(tilt, fromTheRight, test::diffuseMaterial(Rgb(0.5f))), kind)).x;
  };
  for (const RendererKind kind : kBoth) {
    const float toward = brightness(0.5, kind), level = brightness(0, kind), away = brightness(-0.5, kind);
    EXPECT_GT(toward, 1.2f * level);
    EXPECT_LT(away, 0.8f * level);
  }
}

// Lambert's law for the tilted plane, by quadrature over the cells that the maps know: each cell's light from its mean
// direction.
TEST_F(Surfaces, ANormalMapReceivesWhatAPlaneOfThatNormalWould) {
  constexpr double kTilt = 0.4;
  const auto light = [](Vec3d, Vec3d d) { return Rgb(static_cast<float>(std::exp(2 * d.x + d.z))); };
  const BakedScene baked = tilted(kTilt, light, test::diffuseMaterial(Rgb(1.f)), 256);
  const DirectionSet set(256);
  const Vec3d n{0, 0, 1}, mapped{std::sin(kTilt), 0, std::cos(kTilt)};
  double received = 0, constant = 0;
  for (int psi = 0; psi < 256; ++psi) {
    const ClippedCell cell = set.clippedCell(psi, n);
    if (!(cell.solidAngle > 0)) continue;
    const double cosine = std::max(0.0, dot(mapped, normalize(cell.moment))) * cell.solidAngle;
    received += static_cast<double>(light({}, set.direction(psi)).x) * cosine;
    constant += cosine;
  }
  for (const RendererKind kind : kBoth)
    EXPECT_NEAR(centre(render(baked, kind)).x / (received / constant), 1,
                0.03);  // 8-bit normals, the cosine's lower bound
}

TEST_F(Surfaces, HighlightsFollowTheNormalMap) {
  Material m;
  m.metallic = 1;
  m.roughness = 0.3f;
  const auto fromTheRight = [](Vec3d, Vec3d d) { return Rgb(d.x > 0.8 ? 10.f : 0.01f); };
  for (const RendererKind kind : kBoth) {
    const float facing = centre(render(tilted(0.6, fromTheRight, m), kind)).x;  // mirrors 1.2 rad to the right
    EXPECT_GT(facing, 10 * centre(render(tilted(-0.6, fromTheRight, m), kind)).x);
  }
}

TEST_F(Surfaces, MasksHaveHolesThatShowWhatIsBehind) {
  Material mask = glowing(Rgb(5.f));
  mask.alphaMode = AlphaMode::mask;
  mask.baseColorTexture.texture = 0;
  test::BakedSceneBuilder b(1, test::constantRadiance(Rgb(0.f)));
  addPane(b, 0, 1, mask);
  addPane(b, -0.5, 3, glowing(Rgb(2.f)));
  b.addCamera({0, 0, 3}, {0, 0, 0}, 0.4);
  BakedScene baked = b.build();
  const auto left = [](int x, int) {
    return std::array<std::uint8_t, 4>{255, 255, 255, std::uint8_t(x == 0 ? 100 : 200)};
  };
  test::addTexture(baked.scene, 2, left, true);
  for (const RendererKind kind : kBoth) {
    const ImageRgb image = render(baked, kind);
    EXPECT_EQ(image.pixels[static_cast<std::size_t>(12 * 33 + 8)], Rgb(2.f));
    EXPECT_EQ(image.pixels[static_cast<std::size_t>(12 * 33 + 24)], Rgb(5.f));
  }
}

TEST_F(Surfaces, BlendedSurfacesMixInTheOrderOfDistanceNotOfTheFile) {
  for (const bool nearFirst : {true, false}) {
    Material near = glowing({8.f, 0.f, 0.f}), middle = glowing({0.f, 8.f, 0.f});
    near.alphaMode = middle.alphaMode = AlphaMode::blend;
    near.alpha = 0.25f;
    middle.alpha = 0.5f;
    test::BakedSceneBuilder b(1, test::constantRadiance(Rgb(0.f)));
    if (nearFirst) addPane(b, 1, 1, near);
    addPane(b, 0.5, 1, middle);
    if (!nearFirst) addPane(b, 1, 1, near);
    addPane(b, 0, 1, glowing({0.f, 0.f, 8.f}));
    b.addCamera({0, 0, 3}, {0, 0, 0}, 0.4);
    const BakedScene baked = b.build();
    for (const RendererKind kind : kBoth) {
      const Rgb seen = centre(render(baked, kind));
      EXPECT_NEAR(seen.x, 8 * 0.25f, 1e-5f);
      EXPECT_NEAR(seen.y, 8 * 0.75f * 0.5f, 1e-5f);
      EXPECT_NEAR(seen.z, 8 * 0.75f * 0.5f, 1e-5f);
    }
  }
}

TEST_F(Surfaces, WhatIsSolidHidesBlendedSurfacesBehindIt) {
  Material pane = glowing(Rgb(100.f));
  pane.alphaMode = AlphaMode::blend;
  pane.alpha = 0.5f;
  test::BakedSceneBuilder b(1, test::constantRadiance(Rgb(0.f)));
  addPane(b, 0, 1, pane);
  addPane(b, 1, 1, glowing(Rgb(3.f)));
  b.addCamera({0, 0, 3}, {0, 0, 0}, 0.4);
  const BakedScene baked = b.build();
  for (const RendererKind kind : kBoth) EXPECT_EQ(centre(render(baked, kind)), Rgb(3.f));
}

TEST_F(Surfaces, GlassTintsWhatIsBehindAndKeepsItsReflection) {
  Material glass = test::diffuseMaterial({0.9f, 0.5f, 0.25f});
  glass.specular = 1;
  glass.roughness = 0;
  glass.transmission = 1;
  test::BakedSceneBuilder b(14, test::constantRadiance(Rgb(10.f)));
  addPane(b, 1, 1, glass, {true, true, 0});
  addPane(b, 0, 3, glowing(Rgb(4.f)));
  b.addCamera({0, 0, 3}, {0, 0, 0}, 0.4);
  const BakedScene baked = b.build();
  for (const RendererKind kind : kBoth) {
    const Rgb seen = centre(render(baked, kind));
    const float fresnel = 0.04f;  // of index 1.5, straight on
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(seen[c], 10 * fresnel + 4 * (1 - fresnel) * (Rgb{0.9f, 0.5f, 0.25f})[c], 0.05f) << c;
  }
}

TEST_F(Surfaces, UnlitBacksOfOneSidedMaterialsAreNotThere) {
  Material card = test::diffuseMaterial(Rgb(1.f));
  card.unlit = true;
  test::BakedSceneBuilder b(1, test::constantRadiance(Rgb(0.f)));
  addPane(b, -1, 1, card);
  addPane(b, -2, 3, glowing(Rgb(7.f)));
  b.addQuad({-3, -3, 1}, {-3, 3, 1}, {3, 3, 1}, {3, -3, 1}, b.addMaterial(glowing(Rgb(7.f))), 4, 4, {false, false, 0});
  b.addCamera({0, 0, -1.5}, {0, 0, 0}, 0.4);
  const BakedScene baked = b.build();
  for (const RendererKind kind : kBoth) EXPECT_EQ(centre(render(baked, kind)), Rgb(7.f));
}

/// Smooth, and different in every direction.
ImageRgb smoothSky(int width, int height) {
  ImageRgb sky{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double theta = std::numbers::pi * (y + 0.5) / height,
                   phi = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
      const Vec3d d{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
      sky.pixels.push_back(Rgb(Vec3d{2, 2, 2} + d));
    }
  }
  return sky;
}

TEST_F(Surfaces, TheSkyIsWhereItsLightComesFrom) {
  const ImageRgb sky = smoothSky(64, 32);
  const Environment environment(sky, "sky");
  for (const Vec3d target : {Vec3d{5, 1, 0}, Vec3d{-5, 0.5, 2}, Vec3d{0.3, -2, 5}, Vec3d{0, 3, -4}}) {
    test::BakedSceneBuilder b(1, test::constantRadiance(Rgb(0.f)));
    addPane(b, 50, 0.1, glowing(Rgb(1.f)));
    b.addCamera({0, 0, 0}, target, 0.6);
    const BakedScene baked = b.build();
    for (const RendererKind kind : kBoth) {
      const Rgb seen = centre(render(baked, kind, 33, 25, &sky)),
                expected = environment.radiance(Vec3f(normalize(target)));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 0.08f);  // maps are constant within a pixel there
    }
  }
}

TEST_F(Surfaces, BothRenderersAgreeOnAllOfThemTogether) {
  Material bumpy;
  bumpy.metallic = 0.5f;
  bumpy.roughness = 0.4f;
  bumpy.normalTexture.texture = 0;
  Material holes = test::diffuseMaterial({0.8f, 0.3f, 0.2f});
  holes.alphaMode = AlphaMode::mask;
  holes.baseColorTexture.texture = 1;
  holes.doubleSided = true;
  Material veil = test::diffuseMaterial({0.2f, 0.7f, 0.3f});
  veil.alphaMode = AlphaMode::blend;
  veil.alpha = 0.4f;
  veil.normalTexture.texture = 0;
  Material glossy;
  glossy.metallic = 0;
  glossy.roughness = 0.3f;
  const auto light = [](Vec3d p, Vec3d d) {
    return Rgb{1, 2, 3} * static_cast<float>(std::exp(d.x + d.y + 0.2 * p.x));
  };
  test::BakedSceneBuilder b(20, light);
  addPane(b, 0, 2, bumpy, {true, true, 3});
  addPane(b, 0.5, 0.7, holes, {true, false, 0});
  addPane(b, 1, 0.5, veil, {true, true, 0});
  b.addSphere({0.9, 0.6, 0.6}, 0.4, b.addMaterial(glossy), 6, 8);
  b.addCamera({0.4, 0.3, 4}, {0, 0, 0}, 1.0);
  BakedScene baked = b.build();
  test::addTexture(baked.scene, 16, [](int x, int y) {
    return std::array<std::uint8_t, 4>{std::uint8_t(128 + 60 * ((x / 2) % 2)), std::uint8_t(128 - 60 * ((y / 2) % 2)),
                                       230, 255};
  });
  test::addTexture(baked.scene, 8, [](int x, int y) {
    return std::array<std::uint8_t, 4>{255, 255, 255, std::uint8_t((x + y) % 2 ? 255 : 0)};
  });
  test::addTangents(baked.scene);
  const ImageRgb sky = smoothSky(32, 16);
  const ImageRgb single = render(baked, kBoth[0], 97, 71, &sky), multi = render(baked, kBoth[1], 97, 71, &sky);
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < single.pixels.size(); ++i) {
    const Rgb d = single.pixels[i] - multi.pixels[i];
    worst = std::max<double>(worst, std::max(maxComponent(d), -minComponent(d)));
    sum += mean(single.pixels[i]);
  }
  EXPECT_LT(worst, 1e-3 * sum / static_cast<double>(single.pixels.size()));
}

}  // namespace
}  // namespace lucarne::surfaces_test
