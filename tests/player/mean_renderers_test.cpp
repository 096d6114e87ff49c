// Mean directions on the GPU: both renderers, and the reference.
#include <cmath>
#include <random>

#include "player/cell_tables.h"
#include "player/lobe.h"
#include "player/map_tables.h"
#include "player/offscreen.h"
#include "tests/player/coats.h"
#include "tests/player/gl_available.h"
#include "tests/player/picture_values.h"
#include "tests/player/synthetic_maps.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne::mean_renderers_test {
namespace {

using test::BakedScene;
using test::coat;
using test::largestDifference;
using test::meanOf;

ImageRgb render(const BakedScene& baked, RenderOptions options) {
  options.format = LightMapFormat::float32;
  return renderImage(baked.scene, baked.maps, baked.scene.cameras.at(0), options);
}

/// Turns and shortens the means, each texel's otherwise.
void stir(LightMaps& maps) {
  std::mt19937 rng(11);
  const float most = 0.5f / std::sqrt(static_cast<float>(maps.directionCount));
  std::uniform_real_distribution<float> uniform(-most, most);
  for (Vec3f& m : maps.meanDirections) {
    m += Vec3f{uniform(rng), uniform(rng), uniform(rng)};
    m = m / std::max(1.f, std::sqrt(dot(m, m)));
  }
}

class MeanRenderers : public test::GlTest {};

TEST_F(MeanRenderers, SinglepassAndMultipassAgreeOnEveryKindOfSide) {
  for (const int directions : {1, 14, 40}) {
    BakedScene baked = test::furnishedRoom(directions, true);
    stir(baked.maps);
    const ImageRgb single = render(baked, {257, 89, RendererKind::singlepass}),
                   multi = render(baked, {257, 89, RendererKind::multipass});
    EXPECT_LT(largestDifference(single, multi), 1e-3 * meanOf(single)) << directions;
    BakedScene without = baked;
    without.maps.meanDirections.clear();
    EXPECT_GT(largestDifference(single, render(without, {257, 89, RendererKind::singlepass})), 0.01 * meanOf(single));
  }
}

TEST_F(MeanRenderers, UnderANormalMapTheyAgreeToo) {
  for (const int directions : {14, 40}) {
    BakedScene baked = test::furnishedRoom(directions, true);
    stir(baked.maps);
    Image image{4, 4, {}};
    for (int i = 0; i < 16; ++i) image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(90 + 20 * (i % 4)), static_cast<std::uint8_t>(100 + 15 * (i / 4)), 230, 255});
    baked.scene.images.push_back(image);
    Texture texture;
    texture.image = 0;
    baked.scene.textures.push_back(texture);
    baked.scene.materials[1].normalTexture.texture = 0;
    baked.scene.uv0.assign(baked.scene.positions.size(), Vec2f{});
    for (std::size_t i = 0; i < baked.scene.uv0.size(); ++i)
      baked.scene.uv0[i] = {static_cast<float>(i % 4 == 1 || i % 4 == 2), static_cast<float>(i % 4 / 2)};
    const ImageRgb single = render(baked, {129, 65, RendererKind::singlepass}),
                   multi = render(baked, {129, 65, RendererKind::multipass});
    EXPECT_LT(largestDifference(single, multi), 1e-3 * meanOf(single)) << directions;
  }
}

BakedScene plate(int directions, const Material& material, const test::IncidentRadiance& light, Vec3d eye) {
  test::BakedSceneBuilder b(directions, light);
  b.withMeans();
  b.addQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, b.addMaterial(material), 8, 8, {true, true, 4});
  b.addCamera(eye, {0.01, 0.01, 0}, 0.2);
  return b.build();
}

TEST_F(MeanRenderers, AgreeWithTheReference) {
  const auto light = [](Vec3d, Vec3d d) { return Rgb{1.f, 2.f, 3.f} * static_cast<float>(std::exp(3 * (d.x + d.z))); };
  const Vec3d eye{-1, 0.3, 1}, target{0.01, 0.01, 0};
  for (const int directions : {14, 32, 256}) {
    for (const float exponent : {3.f, 40.f}) {
      BakedScene baked = plate(directions, coat(exponent), light, eye);
      const SideMaps& side = baked.maps.sides[0];
      const DirectionSet set(directions);
      std::vector<MeanCell> cells;
      std::vector<Rgb> values;
      std::vector<Vec3f> means;
      for (const SideDirection& d : side.directions) {
        cells.push_back(meanCell(set, d.psi, {0, 0, 1}));
        values.push_back(d.stored() ? baked.maps.directional[d.first] : Rgb{});
        // The same at all texels, away from that of constant light.
        means.push_back(normalize(cells.back().direction + Vec3f{0.05f, -0.03f, 0.02f}) * 0.97f);
        for (std::uint64_t t = 0; d.stored() && t < side.texelCount(); ++t) baked.maps.meanDirections[d.first + t] = means.back();
      }
      const Bsdf bsdf = makeBsdf(baked.scene.materials[0], factorsOf(baked.scene.materials[0]));
      const LobeView view{{0, 0, 1}, Vec3f(normalize(eye - target)), directions};
      const Rgb expected = reflectedRadiance(view, bsdf, cells, values, means, baked.maps.irradiance.at(0));
      for (const RendererKind kind : {RendererKind::singlepass, RendererKind::multipass}) {
        const ImageRgb image = render(baked, {33, 33, kind});
        const Rgb seen = image.pixels[33 * 16 + 16];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / expected[c], 1, 0.01) << directions << " " << exponent;
      }
    }
  }
}

TEST_F(MeanRenderers, ConstantLightGivesAConstantHighlight) {
  constexpr int kSize = 25;
  for (const int directions : {14, 32, 64, 256}) {
    for (const float exponent : {1.f, 10.f, 100.f}) {
      test::BakedSceneBuilder b(directions, test::constantRadiance(Rgb(2.f)));
      b.withMeans();
      b.addQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, b.addMaterial(coat(exponent)), 8, 8);
      b.addCamera({1.5, 0.4, 1.2}, {0.01, 0.01, 0}, 0.2);
      const BakedScene baked = b.build();
      const ImageRgb image = render(baked, {kSize, kSize, RendererKind::singlepass});
      const Bsdf bsdf = makeBsdf(baked.scene.materials[0], factorsOf(baked.scene.materials[0]));
      const Camera& camera = baked.scene.cameras[0];
      const double t = std::tan(camera.yfov / 2);
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const double u = (2 * (x + 0.5) / kSize - 1) * t, v = (1 - 2 * (y + 0.5) / kSize) * t;
          const Vec3d ray = normalize(camera.right * u + camera.up * v - camera.back);
          const Rgb expected = Coat(bsdf).albedo(static_cast<float>(-ray.z)).total * 2.f;
          const Rgb seen = image.pixels[static_cast<std::size_t>(y * kSize + x)];
          EXPECT_NEAR(seen.y / expected.y, 1, 0.03) << directions << " directions, exponent " << exponent;
        }
      }
    }
  }
}

TEST_F(MeanRenderers, TheOtherLobesTakeNoMeans) {
  BakedScene baked = test::furnishedRoom(14, true);
  for (const LobeKind lobe : {LobeKind::barsi, LobeKind::sample}) {
    const RenderOptions options{65, 33, RendererKind::singlepass, LightMapFormat::float32, lobe};
    const ImageRgb before = render(baked, options);
    BakedScene stirred = baked;
    stir(stirred.maps);
    EXPECT_EQ(before.pixels, render(stirred, options).pixels);
  }
}

TEST_F(MeanRenderers, TheirTextureIsCounted) {
  constexpr TextureLimits kLimits{4096, 2048};
  const BakedScene with = test::furnishedRoom(14, true), without = test::furnishedRoom(14);
  const std::uint64_t light = mapTextureBytes(without.maps, LightMapFormat::rgb9e5, kLimits),
                      both = mapTextureBytes(with.maps, LightMapFormat::rgb9e5, kLimits),
                      half = mapTextureBytes(without.maps, LightMapFormat::half, kLimits);
  EXPECT_EQ(both, half);  // 4 bytes more a texel, as half has
  EXPECT_GT(both, light);
  RenderStats stats;
  renderImage(with.scene, with.maps, with.scene.cameras[0], {16, 16, RendererKind::singlepass, LightMapFormat::rgb9e5}, &stats);
  EXPECT_GE(stats.textureBytes, both);
}

}  // namespace
}  // namespace lucarne::mean_renderers_test
