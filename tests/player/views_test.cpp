// Views, each by a property of what it shows.
#include <cmath>
#include <set>
#include <tuple>

#include "player/offscreen.h"
#include "tests/player/gl_available.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::views_test {
namespace {

using test::BakedScene;

class Views : public test::GlTest {};

ImageRgb show(const BakedScene& baked, View view, int width = 96, int height = 72) {
  RenderOptions options{width, height, RendererKind::singlepass, LightMapFormat::float32};
  options.view = view;
  return renderImage(baked.scene, baked.maps, baked.scene.cameras.at(0), options);
}

/// A square of 2 m seen from in front, 8 × 8 texels; light that grows to the right and depends on its direction.
BakedScene plate(int directions, std::optional<test::SideSpec> back = std::nullopt, Vec3d eye = {0.3, 0.2, 4}) {
  const auto light = [](Vec3d p, Vec3d d) {
    return Rgb{static_cast<float>(2 + p.x), static_cast<float>(1.5 + d.x), static_cast<float>(2 + d.y)};
  };
  test::BakedSceneBuilder b(directions, light);
  Material m = test::diffuseMaterial({0.8f, 0.4f, 0.2f});
  m.specular = 1;
  b.addQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, b.addMaterial(m), 8, 8, {}, back);
  b.addCamera(eye, {0, 0, 0}, 0.8);
  BakedScene baked = b.build();
  baked.maps.photons.assign(baked.maps.irradiance.size(), 0.f);
  baked.maps.relativeError = baked.maps.photons;
  return baked;
}

const Rgb& at(const ImageRgb& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y * image.width + x)];
}
const Rgb& centre(const ImageRgb& image) { return at(image, image.width / 2, image.height / 2); }

TEST_F(Views, DirectionsSumToTheIrradiance) {
  for (const int directions : {5, 40}) {
    const BakedScene baked = plate(directions);
    ImageRgb sum = show(baked, {ViewKind::direction, 0});
    for (int psi = 1; psi < directions; ++psi) {
      const ImageRgb one = show(baked, {ViewKind::direction, psi});
      for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += one.pixels[i];
    }
    const ImageRgb all = show(baked, {ViewKind::irradiance});
    int lit = 0;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum.pixels[i][c], all.pixels[i][c], 2e-3f * all.pixels[i][c]);
      lit += all.pixels[i].x > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, 1000);
  }
}

TEST_F(Views, EachSideShowsItsOwnDirections) {
  const BakedScene front = plate(14, test::SideSpec{}), behind = plate(14, test::SideSpec{}, {0.3, 0.2, -4});
  const DirectionSet set(14);
  for (int psi = 0; psi < 14; ++psi) {
    const bool above = set.reaches(psi, {0, 0, 1}), below = set.reaches(psi, {0, 0, -1});
    EXPECT_EQ(centre(show(front, {ViewKind::direction, psi})).x > 0, above);
    EXPECT_EQ(centre(show(behind, {ViewKind::direction, psi})).x > 0, below);
  }
}

TEST_F(Views, NumbersAreThoseOfTheTexelUnderThePixel) {
  BakedScene baked = plate(3);
  for (std::size_t i = 0; i < baked.maps.photons.size(); ++i) {
    baked.maps.photons[i] = static_cast<float>(100'000 + i);
    baked.maps.relativeError[i] = static_cast<float>(i) / 64;
  }
  const ImageRgb photons = show(baked, {ViewKind::photons}), errors = show(baked, {ViewKind::error});
  std::set<float> seen;
  for (std::size_t i = 0; i < photons.pixels.size(); ++i) {
    if (photons.pixels[i].x <= 0) continue;
    seen.insert(photons.pixels[i].x);
    EXPECT_EQ(errors.pixels[i].x, (photons.pixels[i].x - 100'000) / 64);
  }
  EXPECT_EQ(seen.size(), 64u);  // every texel, and nothing between two
}

TEST_F(Views, DensityIsTexelsAMetreWhateverTheSlantAndTheScale) {
  for (const Vec3d eye : {Vec3d{0, 0.1, 3}, Vec3d{3, 1, 0.5}}) {
    const ImageRgb image = show(plate(1, std::nullopt, eye), {ViewKind::density});
    for (const Rgb& p : image.pixels) {
      if (p.x <= 0) continue;
      EXPECT_NEAR(p.x, 4.f, 0.05f);  // 8 texels on 2 m
    }
    EXPECT_GT(centre(image).x, 0);
  }
}

TEST_F(Views, TexelsAreChequeredOverTheIrradiance) {
  const BakedScene baked = plate(3);
  const ImageRgb grid = show(baked, {ViewKind::texels}), E = show(baked, {ViewKind::irradiance});
  int dark = 0, full = 0;
  for (std::size_t i = 0; i < E.pixels.size(); ++i) {
    if (E.pixels[i].x <= 0) continue;
    const float share = grid.pixels[i].x / E.pixels[i].x;
    EXPECT_TRUE(std::abs(share - 1) < 1e-4f || std::abs(share - 0.5f) < 1e-4f) << share;
    (share > 0.75f ? full : dark) += 1;
  }
  EXPECT_NEAR(static_cast<double>(dark) / (dark + full), 0.5, 0.05);
}

TEST_F(Views, ChartsHaveOneColourEachAndDifferFromTheirNeighbours) {
  const BakedScene baked = test::furnishedRoom(4);
  std::set<std::tuple<float, float, float>> colours;
  for (const Rgb& p : show(baked, {ViewKind::charts}, 200, 150).pixels) {
    colours.insert({p.x, p.y, p.z});
    EXPECT_LE(maxComponent(p), 1.f);
  }
  EXPECT_GT(colours.size(), 8u);
  EXPECT_LE(colours.size(), baked.maps.charts.size() + 1);  // and the background
}

TEST_F(Views, AlbedoAndNormalAreThoseOfTheMaterialAndThePlane) {
  const BakedScene baked = plate(3);
  EXPECT_EQ(centre(show(baked, {ViewKind::albedo})), (Rgb{0.8f, 0.4f, 0.2f}));
  const Rgb n = centre(show(baked, {ViewKind::normals}));
  EXPECT_NEAR(n.x, 0.5f, 1e-6f);
  EXPECT_NEAR(n.z, 1.f, 1e-6f);
}

TEST_F(Views, WiresLieOnTheEdgesOnly) {
  const BakedScene baked = plate(3, std::nullopt, {0, 0, 4});
  const ImageRgb wires = show(baked, {ViewKind::wireframe}, 161, 121);
  const Rgb inside = at(wires, 80 + 20, 60 + 10);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(inside[c], 0.35f * (Rgb{0.8f, 0.4f, 0.2f})[c], 1e-3f);
  EXPECT_GT(at(wires, 80, 60).x, 0.6f);  // the diagonal of the square
}

TEST_F(Views, ADirectionThatIsNotThereIsAnErrorOfUsage) {
  const BakedScene baked = plate(3);
  for (const int psi : {-1, 3}) {
    try {
      show(baked, {ViewKind::direction, psi});
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
    }
  }
}

TEST_F(Views, SupersamplingIsTheMeanOfShiftedPictures) {
  const BakedScene baked = plate(3);
  RenderOptions options{48, 36, RendererKind::singlepass, LightMapFormat::float32};
  const Camera& camera = baked.scene.cameras.at(0);
  options.supersamples = 3;
  const ImageRgb fine = renderImage(baked.scene, baked.maps, camera, options);
  options.supersamples = 1;
  const ImageRgb coarse = renderImage(baked.scene, baked.maps, camera, options);
  options.width *= 3;
  options.height *= 3;
  const ImageRgb large = renderImage(baked.scene, baked.maps, camera, options);
  double errorFine = 0, errorCoarse = 0;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 48; ++x) {
      Rgb sum{};
      for (int k = 0; k < 9; ++k) sum += at(large, 3 * x + k % 3, 3 * y + k / 3) / 9.f;
      errorFine += std::abs(at(fine, x, y).y - sum.y);
      errorCoarse += std::abs(at(coarse, x, y).y - sum.y);
    }
  }
  EXPECT_LT(errorFine, 0.1 * errorCoarse);  // a sample on the plate's border may fall to either side of it
  EXPECT_GT(errorCoarse, 1);
}

}  // namespace
}  // namespace lucarne::views_test
