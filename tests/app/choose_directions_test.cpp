// How many directions a scene asks for.
#include "app/choose_directions.h"

#include <gtest/gtest.h>

#include "app/bake_scene.h"
#include "dlm/lobe_width.h"
#include "tracer/optics/phong.h"

namespace lucarne::choose_directions_test {
namespace {

/// Two triangles of one square metre each with metals of given exponents; 0: a Lambert surface.
Scene twoMetals(float a, float b) {
  Scene scene;
  scene.materials.clear();
  for (const float exponent : {a, b}) {
    Material m;
    m.metallic = exponent > 0 ? 1.f : 0.f;
    m.specular = exponent > 0 ? 1.f : 0.f;
    m.roughness = roughnessFromPhong(exponent);
    scene.materials.push_back(m);
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const Vec3f p : {Vec3f{0, 0, 0}, Vec3f{2, 0, 0}, Vec3f{0, 1, 0}}) scene.positions.push_back(p);
    scene.triangles.push_back({{first, first + 1, first + 2}, static_cast<std::uint32_t>(scene.materials.size() - 1)});
  }
  return scene;
}

TEST(ChooseDirections, TheLeastThatShowsTheGlossySurfaceAsSharpAsItIs) {
  EXPECT_EQ(chooseDirections(twoMetals(10, 10)).directions, 14);
  EXPECT_EQ(chooseDirections(twoMetals(10, 30)).directions, 32);
  EXPECT_EQ(chooseDirections(twoMetals(60, 30)).directions, 64);
  const DirectionChoice sharp = chooseDirections(twoMetals(1000, 10));
  EXPECT_EQ(sharp.directions, 64);
  EXPECT_NEAR(sharp.shown, 0.5, 1e-6);
  EXPECT_NEAR(sharp.glossy, 1, 1e-9);
}

TEST(ChooseDirections, SurfacesWithoutALobeDoNotCount) {
  const DirectionChoice half = chooseDirections(twoMetals(30, 0));
  EXPECT_EQ(half.directions, 32);
  EXPECT_NEAR(half.glossy, 0.5, 1e-9);
  const DirectionChoice none = chooseDirections(twoMetals(0, 0));
  EXPECT_EQ(none.directions, 14);
  EXPECT_EQ(none.glossy, 0);
}

TEST(ChooseDirections, ANumberThatIsGivenStays) {
  BakeOptions options;
  options.directions = 20;
  settleDirections(twoMetals(1000, 1000), options);
  EXPECT_EQ(options.directions, 20);
  options.chooseDirections = true;
  settleDirections(twoMetals(1000, 1000), options);
  EXPECT_EQ(options.directions, 64);
}

}  // namespace
}  // namespace lucarne::choose_directions_test
