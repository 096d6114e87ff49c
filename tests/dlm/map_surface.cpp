#include "dlm/map_surface.h"

#include <gtest/gtest.h>

#include "tests/base/temp_folder.h"
#include "tests/dlm/dlm_file_fixture.h"

namespace lucarne::map_surface_test {
namespace {

using test::BakedScene;

/// A tilted parallelogram of 3 m × 5 m in 6 × 5 texels, far from the origin.
BakedScene tilted() {
  BakedScene scene(1);
  scene.builder.addDiffuse(Rgb(0.5f));
  const Vec3d a{100, 20, -300}, u{3, 0, 0}, v{0, 3, 4};
  scene.builder.addQuad(a, a + v, a + v + u, a + u, 0);
  scene.addChart(0, {0, -0.8f, 0.6f}, 6, 5, 2, 3, 0.7);
  scene.addSide(false, [](int, int) { return Rgb(1.f); });
  scene.setAtlas(16, 16);
  return scene;
}

TEST(MapSurface, TexelAreasAddUpToTheSurface) {
  const TempFolder folder;
  const Dlm dlm = tilted().reread(folder / "t.dlm");
  const TexelAreas areas(dlm);
  double sum = 0;
  for (std::uint64_t t = 0; t < 30; ++t) {
    EXPECT_NEAR(areas.of(0, t), 0.5, 1e-4) << t;
    sum += areas.of(0, t);
  }
  EXPECT_NEAR(sum, 15, 1e-4);
}

TEST(MapSurface, PlacesInTheRectangleArePointsOfTheSurface) {
  const TempFolder folder;
  const Dlm dlm = tilted().reread(folder / "t.dlm");
  const auto expectPoint = [&](Vec2d st, Vec3d expected) {
    EXPECT_LT(length(surfaceAt(dlm, 0, st) - expected), 1e-3) << st.x << " " << st.y;
  };
  expectPoint({0, 0}, {100, 20, -300});
  expectPoint({3, 2.5}, {101.5, 21.5, -298});
  expectPoint({6, 5}, {103, 23, -296});
  expectPoint({9, 2.5}, {103, 21.5, -298});  // outside: the nearest
}

TEST(MapSurface, LayoutsAreTheSameOnlyWithTheSameSurfacesInTheSameRectangles) {
  const TempFolder folder;
  const Dlm a = test::smallBakedScene(1).reread(folder / "a.dlm"),
            b = test::smallBakedScene(2).reread(folder / "b.dlm");
  EXPECT_TRUE(sameLayout(a, b));
  EXPECT_FALSE(sameLayout(a, tilted().reread(folder / "c.dlm")));
  Dlm moved = b;
  moved.scene.positions[0].x += 0.125f;
  EXPECT_FALSE(sameLayout(a, moved));
  Dlm repacked = b;
  ++repacked.maps.charts[0].atlasX;
  EXPECT_FALSE(sameLayout(a, repacked));
}

}  // namespace
}  // namespace lucarne::map_surface_test
