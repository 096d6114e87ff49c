// Densities of light maps that a file asks for in the extras of its nodes.
#include <gtest/gtest.h>

#include "tests/tracer/gltf_maker.h"

namespace lucarne::gltf_density_test {
namespace {

using test::Json;

double densityWith(const Json& extras) {
  test::GltfMaker maker = test::squareMaker();
  maker.json["nodes"][0]["extras"] = extras;
  return maker.read().instances.at(0).texelsPerMetre;
}

TEST(GltfDensity, IsReadFromFlatAndFromNestedExtras) {
  EXPECT_EQ(densityWith({{"lucarne.texels_per_metre", 64}}), 64);
  EXPECT_EQ(densityWith({{"lucarne", {{"texels_per_metre", 2.5}}}}), 2.5);
}

TEST(GltfDensity, IsNoneWhereTheExtrasAreOfOthers) {
  EXPECT_EQ(test::squareMaker().read().instances.at(0).texelsPerMetre, 0);
  for (const Json& extras : {Json(7), Json("lucarne"), Json::array({1}), Json{{"lucarne", 3}}, Json{{"other", 64}}})
    EXPECT_EQ(densityWith(extras), 0) << extras;
}

TEST(GltfDensity, HoldsBelowANodeUntilAnotherSaysOtherwise) {
  test::GltfMaker maker = test::squareMaker();
  maker.json["nodes"] = Json::array({{{"children", {1, 2}}, {"extras", {{"lucarne.texels_per_metre", 8}}}},
                                     {{"mesh", 0}},
                                     {{"mesh", 0}, {"extras", {{"lucarne.texels_per_metre", 32}}}}});
  const Scene scene = maker.read();
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].texelsPerMetre, 8);
  EXPECT_EQ(scene.instances[1].texelsPerMetre, 32);
}

TEST(GltfDensity, ThatIsNoneIsRefusedWithItsPlace) {
  for (const Json& value : {Json(0), Json(-3), Json("dense"), Json(1e300), Json(nullptr)}) {
    test::GltfMaker maker = test::squareMaker();
    maker.json["nodes"][0]["extras"] = {{"lucarne.texels_per_metre", value}};
    EXPECT_NE(test::complaint(maker).find("nodes[0].extras.lucarne.texels_per_metre"), std::string::npos) << value;
  }
}

}  // namespace
}  // namespace lucarne::gltf_density_test
