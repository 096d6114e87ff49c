#include <cmath>
#include <numbers>

#include "player/cell_tables.h"
#include "player/lobe.h"
#include "player/offscreen.h"
#include "tests/player/coats.h"
#include "tests/player/gl_available.h"
#include "tests/player/picture_values.h"
#include "tests/player/synthetic_maps.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne::renderers_test {
namespace {

using test::BakedScene;
using test::coat;
using test::largestDifference;
using test::meanOf;

ImageRgb render(const BakedScene& baked, RendererKind renderer, LightMapFormat format, int width, int height,
                RenderStats* stats = nullptr) {
  return renderImage(baked.scene, baked.maps, baked.scene.cameras.at(0), {width, height, renderer, format}, stats);
}

const Rgb& centre(const ImageRgb& image) {
  return image.pixels[static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2)];
}

class Renderers : public test::GlTest {};

TEST_F(Renderers, SinglepassAndMultipassAgreeOnEveryKindOfSide) {
  for (const int directions : {1, 14, 40}) {
    const BakedScene baked = test::furnishedRoom(directions);
    const ImageRgb single = render(baked, RendererKind::singlepass, LightMapFormat::float32, 257, 89);
    const ImageRgb multi = render(baked, RendererKind::multipass, LightMapFormat::float32, 257, 89);
    ASSERT_GT(meanOf(single), 0);
    EXPECT_LT(largestDifference(single, multi), 1e-3 * meanOf(single)) << directions << " directions";
  }
}

TEST_F(Renderers, TheSameInputGivesTheSameBits) {
  const BakedScene baked = test::furnishedRoom(14);
  for (const RendererKind kind : {RendererKind::singlepass, RendererKind::multipass}) {
    const ImageRgb a = render(baked, kind, LightMapFormat::half, 131, 77),
                   b = render(baked, kind, LightMapFormat::half, 131, 77);
    EXPECT_EQ(a.pixels, b.pixels);
  }
}

TEST_F(Renderers, CompactFormatsStayCloseToFloat) {
  const BakedScene baked = test::furnishedRoom(14);
  const ImageRgb exact = render(baked, RendererKind::singlepass, LightMapFormat::float32, 160, 120);
  const ImageRgb half = render(baked, RendererKind::singlepass, LightMapFormat::half, 160, 120);
  const ImageRgb shared = render(baked, RendererKind::singlepass, LightMapFormat::rgb9e5, 160, 120);
  EXPECT_NEAR(meanOf(half) / meanOf(exact), 1, 1e-3);
  EXPECT_NEAR(meanOf(shared) / meanOf(exact), 1, 1e-3);
  EXPECT_GT(largestDifference(shared, exact), 0);  // they are another format indeed
}

TEST_F(Renderers, CountersShowWhatSortingSaves) {
  const BakedScene baked = test::furnishedRoom(14);
  RenderStats stats;
  render(baked, RendererKind::multipass, LightMapFormat::float32, 16, 16, &stats);
  EXPECT_EQ(stats.counts.directionSwitches, 14u);
  EXPECT_GT(stats.unsorted.directionSwitches, 100u);
  EXPECT_LT(stats.counts.draws, stats.unsorted.draws);
  render(baked, RendererKind::singlepass, LightMapFormat::float32, 16, 16, &stats);
  EXPECT_EQ(stats.counts.directionSwitches, 0u);
  EXPECT_LT(stats.visibleCharts, stats.charts);
  EXPECT_EQ(stats.counts.draws,
            1u + 5u + 1u);  // the pre-pass, one a material in sight, and one material is on flat and curved charts
  EXPECT_GT(stats.textureBytes, stats.lightMapBytes);
}

/// Looks straight or aslant at the middle of a square of 2 m.
BakedScene plate(int directions, const Material& material, const test::IncidentRadiance& light, Vec3d eye,
                 test::SideSpec front = {}, std::optional<test::SideSpec> back = std::nullopt) {
  test::BakedSceneBuilder b(directions, light);
  b.addQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, b.addMaterial(material), 8, 8, front, back);
  b.addCamera(eye, {0.01, 0.01, 0}, 0.2);
  return b.build();
}

TEST_F(Renderers, DiffuseLightIsAlbedoOverPiTimesIrradiance) {
  const Rgb albedo{0.8f, 0.4f, 0.2f}, L{10.f, 20.f, 30.f};
  const BakedScene baked =
      plate(14, test::diffuseMaterial(albedo), test::constantRadiance(L), {0.5, 0.3, 2}, {true, false, 0});
  const Rgb Lo = centre(render(baked, RendererKind::singlepass, LightMapFormat::half, 33, 17));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(Lo[c], albedo[c] * L[c], 1e-4f * L[c]);  // E = π·L
}

TEST_F(Renderers, EmissionIsAddedAndUnlitSidesShowNothingElse) {
  Material m = test::diffuseMaterial({0.5f, 0.5f, 0.5f}, {7.f, 8.f, 9.f});
  const BakedScene baked = plate(14, m, test::constantRadiance(Rgb(100.f)), {0, 0, 2}, {false, false, 0});
  const ImageRgb image = render(baked, RendererKind::singlepass, LightMapFormat::half, 9, 9);
  EXPECT_EQ(centre(image), (Rgb{7.f, 8.f, 9.f}));
}

TEST_F(Renderers, ABackThatAbsorbsIsBlackAndATwoSidedOneHasItsOwnLight) {
  const auto light = [](Vec3d, Vec3d direction) { return direction.z > 0 ? Rgb(1.f) : Rgb(5.f); };
  const Material m = test::diffuseMaterial(Rgb(1.f), Rgb(3.f));
  const BakedScene oneSided = plate(64, m, light, {0, 0, -2}, {true, false, 0});
  EXPECT_EQ(centre(render(oneSided, RendererKind::singlepass, LightMapFormat::half, 9, 9)), Rgb(0.f));
  const BakedScene both = plate(64, m, light, {0, 0, -2}, {true, false, 0}, test::SideSpec{true, false, 0});
  EXPECT_NEAR(centre(render(both, RendererKind::singlepass, LightMapFormat::half, 9, 9)).x, 3 + 5, 0.4);
}

// The shaders' lobes against those of lobe.h, in both renderers, at the pixel that looks at the middle of the plate.
TEST_F(Renderers, EveryLobeIsThatOfTheReference) {
  constexpr int kDirections = 32;
  const auto light = [](Vec3d, Vec3d d) { return Rgb{static_cast<float>(1 + d.x), static_cast<float>(2 + d.y), 1.f}; };
  const Vec3d eye{0.9, 0.4, 1.2}, target{0.01, 0.01, 0};
  for (const float exponent : {3.f, 40.f}) {
    const BakedScene baked = plate(kDirections, coat(exponent), light, eye);
    const DirectionSet set(kDirections);
    std::vector<LobeCell> cells;
    std::vector<Rgb> values;
    for (const SideDirection& d : baked.maps.sides.at(0).directions) {
      cells.push_back(lobeCell(set, d.psi, {0, 0, 1}));
      values.push_back(d.stored() ? baked.maps.directional[d.first] : Rgb{});
    }
    const Bsdf bsdf = makeBsdf(baked.scene.materials[0], factorsOf(baked.scene.materials[0]));
    for (const LobeKind lobe : {LobeKind::cell, LobeKind::barsi, LobeKind::sample}) {
      const LobeView view{{0, 0, 1}, Vec3f(normalize(eye - target)), kDirections, lobe};
      const Rgb expected = reflectedRadiance(view, bsdf, cells, values, baked.maps.irradiance.at(0));
      for (const RendererKind kind : {RendererKind::singlepass, RendererKind::multipass}) {
        const RenderOptions options{33, 33, kind, LightMapFormat::float32, lobe};
        const Rgb seen = centre(renderImage(baked.scene, baked.maps, baked.scene.cameras.at(0), options));
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(seen[c] / expected[c], 1, 0.01) << exponent << " " << static_cast<int>(lobe);
      }
    }
  }
}

/// Largest relative difference from L·ρ(cosθ) over all pixels that show something; θ from the geometry of each pixel.
template <class CosineAt>
double worstHighlight(const BakedScene& baked, float L, const CosineAt& cosineAt, int size) {
  const ImageRgb image = render(baked, RendererKind::singlepass, LightMapFormat::float32, size, size);
  const Bsdf bsdf = makeBsdf(baked.scene.materials[0], factorsOf(baked.scene.materials[0]));
  double worst = 0;
  int shown = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Rgb seen = image.pixels[static_cast<std::size_t>(y * size + x)];
      const double cosine = cosineAt(x, y);
      if (seen.x <= 0 || cosine < 0.15) continue;
      ++shown;
      const Rgb expected = Coat(bsdf).albedo(static_cast<float>(cosine)).total * L;
      for (int c = 0; c < 3; ++c) worst = std::max<double>(worst, std::abs(seen[c] / expected[c] - 1));
    }
  }
  EXPECT_GT(shown, size * size / 4);
  return worst;
}

/// Unit direction from the eye through the middle of a pixel.
Vec3d rayThrough(const Camera& camera, int x, int y, int size) {
  const double t = std::tan(camera.yfov / 2);
  const double u = (2 * (x + 0.5) / size - 1) * t, v = (1 - 2 * (y + 0.5) / size) * t;
  return normalize(camera.right * u + camera.up * v - camera.back);
}

TEST_F(Renderers, ConstantLightGivesAConstantHighlightOnAFlatPlate) {
  constexpr int kSize = 25;
  for (const int directions : {14, 32, 64, 256}) {
    for (const float exponent : {1.f, 3.f, 10.f, 30.f, 100.f}) {
      const BakedScene baked = plate(directions, coat(exponent), test::constantRadiance(Rgb(2.f)), {1.5, 0.4, 1.2});
      const Camera& camera = baked.scene.cameras[0];
      const double worst = worstHighlight(
          baked, 2.f, [&](int x, int y) { return -rayThrough(camera, x, y, kSize).z; }, kSize);
      EXPECT_LT(worst, 2e-3) << directions << " directions, exponent " << exponent;
    }
  }
}

/// True between the centres of a sphere patch's texels; outside them maps are clamped, in a bake too, and hold the
/// light of another normal.
bool amongTexelCentres(Vec3d n, int texels) {
  const Vec3d a{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  const double margin = 1 - 1.0 / texels, middle = a.x + a.y + a.z - maxComponent(a) - minComponent(a);
  return middle < margin * maxComponent(a);
}

TEST_F(Renderers, ConstantLightGivesAConstantHighlightOnASphere) {
  constexpr int kSize = 31, kTexels = 32;
  for (const int directions : {14, 32, 64, 256}) {
    test::BakedSceneBuilder b(directions, test::constantRadiance(Rgb(2.f)));
    b.addSphere({0, 0, 0}, 1, b.addMaterial(coat(1)), 24, kTexels);
    b.addCamera({3, 2, 4}, {0, 0, 0}, 0.4);
    BakedScene baked = b.build();
    const Camera& camera = baked.scene.cameras[0];
    const double radius = 1 / baked.scene.frame.scale;
    const auto cosineAt = [&](int x, int y) {  // at the first meeting with the sphere around the local origin
      const Vec3d d = rayThrough(camera, x, y, kSize);
      const double along = dot(camera.position, d),
                   rest = along * along - dot(camera.position, camera.position) + radius * radius;
      if (rest <= 0) return 0.;
      const Vec3d n = normalize(camera.position - d * (along + std::sqrt(rest)));
      return amongTexelCentres(n, kTexels) ? -dot(n, d) : 0.;
    };
    for (const float exponent : {1.f, 3.f, 10.f, 30.f, 100.f}) {
      baked.scene.materials[0] = coat(exponent);
      EXPECT_LT(worstHighlight(baked, 2.f, cosineAt, kSize), 2e-2)
          << directions << " directions, exponent " << exponent;
    }
  }
}

TEST_F(Renderers, AgreesWithTheReferenceOnThePlate) {
  // Light that depends on direction alone, so every texel holds the same and bilinear lookup adds nothing.
  const auto light = [](Vec3d, Vec3d d) { return Rgb{1.f, 2.f, 3.f} * static_cast<float>(std::exp(3 * (d.x + d.z))); };
  Material m = coat(20);
  m.metallic = 0.4f;
  const BakedScene baked = plate(32, m, light, {-1, 0.3, 1}, {true, true, 4});
  const Camera& camera = baked.scene.cameras[0];
  const ImageRgb image = render(baked, RendererKind::singlepass, LightMapFormat::float32, 25, 25);
  const SideMaps& side = baked.maps.sides[0];
  const DirectionSet set(32);
  std::vector<LobeCell> cells;
  std::vector<Rgb> values;
  for (const SideDirection& d : side.directions) {
    cells.push_back(lobeCell(set, d.psi, {0, 0, 1}));
    values.push_back(d.stored() ? baked.maps.directional[d.first] : Rgb{});
  }
  const Material& material = baked.scene.materials[0];
  const Bsdf bsdf = makeBsdf(material, factorsOf(material));
  for (int y = 0; y < 25; ++y) {
    for (int x = 0; x < 25; ++x) {
      const Vec3f toEye(-rayThrough(camera, x, y, 25));
      const Rgb expected = reflectedRadiance({{0, 0, 1}, toEye, 32}, bsdf, cells, values, baked.maps.irradiance[0]);
      const Rgb seen = image.pixels[static_cast<std::size_t>(y * 25 + x)];
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 2e-3f * expected[c]);
    }
  }
}

TEST_F(Renderers, DrawsAtTheExtremesOfLight) {
  for (const float L : {1e-12f, 1e12f}) {
    const BakedScene baked = plate(14, coat(10), test::constantRadiance(Rgb(L)), {1, 0, 1});
    for (const LightMapFormat format : {LightMapFormat::half, LightMapFormat::rgb9e5, LightMapFormat::float32}) {
      const Rgb Lo = centre(render(baked, RendererKind::singlepass, format, 8, 8)) / L;
      EXPECT_GT(Lo.x, 0.5f);
      EXPECT_LT(Lo.x, 1.0f);
    }
  }
}

TEST_F(Renderers, TexturesKeepTheirMipmapLevelUpToTheEdgesOfTriangles) {
  // A fine checkerboard seen from near: black or white; grey means that a coarser level was taken somewhere.
  constexpr int kSize = 64;
  test::BakedSceneBuilder b(14, test::constantRadiance(Rgb(1.f)));
  Material m = test::diffuseMaterial(Rgb(1.f));
  m.baseColorTexture.texture = 0;
  const std::uint32_t material = b.addMaterial(m);
  for (int i = -3; i < 3; ++i) {
    b.addQuad({i * 0.3, -1, 0}, {(i + 1) * 0.3, -1, 0.02 * (i + 3)}, {(i + 1) * 0.3, 1, 0.02 * (i + 3)},
              {i * 0.3, 1, 0}, material, 2, 2);
  }
  b.addCamera({0, 0, 0.45}, {0.01, 0.01, 0}, 0.8);
  BakedScene baked = b.build();
  Image image{kSize, kSize, {}};
  for (int i = 0; i < kSize * kSize; ++i) image.rgba.insert(image.rgba.end(), 4, (i + i / kSize) % 2 ? 255 : 0);
  baked.scene.images.push_back(image);
  Texture texture;
  texture.image = 0;
  texture.nearest = true;
  baked.scene.textures.push_back(texture);
  for (const RendererKind kind : {RendererKind::singlepass, RendererKind::multipass}) {
    const ImageRgb picture = render(baked, kind, LightMapFormat::float32, 751, 151);
    int grey = 0, white = 0;
    for (const Rgb& p : picture.pixels) {
      grey += p.x > 0.01f && p.x < 0.99f ? 1 : 0;
      white += p.x >= 0.99f ? 1 : 0;
    }
    EXPECT_EQ(grey, 0);
    EXPECT_GT(white, 20000);
  }
}

TEST_F(Renderers, MaterialsReadTheirOwnTextureCoordinatesNotThoseOfTheAtlas) {
  Material m = test::diffuseMaterial(Rgb(1.f));
  m.baseColorTexture.texture = 0;
  m.baseColorTexture.uvSet = 1;
  BakedScene baked = plate(14, m, test::constantRadiance(Rgb(1.f)), {0.5, 0.3, 2}, {true, false, 0});
  Image image{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};  // black, white
  baked.scene.images.push_back(image);
  Texture texture;
  texture.image = 0;
  texture.nearest = true;
  baked.scene.textures.push_back(texture);
  baked.scene.uv0.assign(baked.scene.positions.size(), Vec2f{0.25f, 0.5f});
  baked.scene.uv1.assign(baked.scene.positions.size(), Vec2f{0.75f, 0.5f});
  EXPECT_NEAR(centre(render(baked, RendererKind::singlepass, LightMapFormat::float32, 33, 17)).x, 1.f, 1e-4f);
}

TEST_F(Renderers, RowsGoFromTheTopAndColumnsFromTheLeft) {
  const auto light = [](Vec3d p, Vec3d) { return Rgb{static_cast<float>(p.x + 1), static_cast<float>(p.y + 1), 1.f}; };
  const BakedScene baked = plate(14, test::diffuseMaterial(Rgb(1.f)), light, {0, 0, 8}, {true, false, 0});
  const ImageRgb image = render(baked, RendererKind::singlepass, LightMapFormat::float32, 21, 11);
  const auto at = [&](int x, int y) { return image.pixels[static_cast<std::size_t>(y * 21 + x)]; };
  EXPECT_GT(at(15, 5).x, at(5, 5).x + 0.1f);
  EXPECT_GT(at(10, 1).y, at(10, 9).y + 0.1f);
}

TEST_F(Renderers, ImpossibleSizesAreAnErrorOfUsage) {
  const BakedScene baked = plate(1, coat(1), test::constantRadiance(Rgb(1.f)), {1, 0, 1});
  for (const auto& [w, h] : {std::pair{0, 5}, std::pair{5, -1}, std::pair{1 << 20, 5}}) {
    try {
      render(baked, RendererKind::singlepass, LightMapFormat::half, w, h);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
    }
  }
}

TEST_F(Renderers, ASceneWithoutChartsIsABadInput) {
  BakedScene baked = plate(1, coat(1), test::constantRadiance(Rgb(1.f)), {1, 0, 1});
  baked.scene.chartOfTriangle.clear();
  EXPECT_THROW(render(baked, RendererKind::singlepass, LightMapFormat::half, 8, 8), InputError);
}

}  // namespace
}  // namespace lucarne::renderers_test
