// moments.exr: what is written comes back, and what nobody wrote is refused.
#include "base/files.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/dlm/dlm_file_fixture.h"

namespace lucarne::moments_file_test {
namespace {

using nlohmann::json;

test::BakedScene sceneWithMeans(int directionCount = 14) {
  test::BakedScene scene = test::smallBakedScene(1, directionCount);
  scene.addMeans();
  return scene;
}

TEST(MomentsFile, MeansComeBackWithinAStepAndExactlyTheSecondTime) {
  const TempFolder folder;
  for (const int count : {14, 256, 3000}) {
    const test::BakedScene scene = sceneWithMeans(count);
    const Dlm once = scene.reread(folder / "a.dlm");
    ASSERT_EQ(once.maps.meanDirections.size(), once.maps.directional.size());
    const float step = 2 * meanReach(count) / 1023;
    for (std::size_t i = 0; i < once.maps.meanDirections.size(); ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(once.maps.meanDirections[i][c], scene.maps().meanDirections[i][c], step);
    writeDlm(folder / "b.dlm", scene.builder.build(), scene.uv(), once.maps, json::object(), {});
    EXPECT_EQ(readFile(folder / "a.dlm" / "moments.exr").size() > 0, true);
    const Dlm twice = readDlm(folder / "b.dlm");
    // Where a mean was cut to length 1 it may move by a step once more.
    std::size_t moved = 0;
    for (std::size_t i = 0; i < once.maps.meanDirections.size(); ++i) moved += !(twice.maps.meanDirections[i] == once.maps.meanDirections[i]);
    EXPECT_LE(moved, once.maps.meanDirections.size() / 4);
  }
}

TEST(MomentsFile, IsThereOnlyWhereThereAreMeans) {
  const TempFolder folder;
  test::smallBakedScene().write(folder / "a.dlm");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.dlm" / "moments.exr"));
  EXPECT_FALSE(readDlm(folder / "a.dlm").maps.hasMeans());
  EXPECT_FALSE(readManifest(folder / "a.dlm")["directional"].contains("means"));
  sceneWithMeans().write(folder / "b.dlm");
  EXPECT_TRUE(readManifest(folder / "b.dlm")["files"].contains("moments.exr"));
}

TEST(MomentsFile, EveryFormatOfTheLightHasThem) {
  const TempFolder folder;
  for (const MapFormat format : {MapFormat::half, MapFormat::float32, MapFormat::rgb9e5, MapFormat::ldr8}) {
    sceneWithMeans().write(folder / "a.dlm", {format});
    EXPECT_TRUE(readDlm(folder / "a.dlm").maps.hasMeans());
  }
}

class HostileMoments : public ::testing::Test {
 protected:
  HostileMoments() { sceneWithMeans().write(path_, {MapFormat::float32, ExrCompression::none}); }
  std::string refusal() {
    return errorOf(ExitCode::badInput, [&] { readDlm(path_); });
  }
  void expectRefused(const std::string& text) {
    const std::string error = refusal();
    EXPECT_NE(error.find(text), std::string::npos) << error;
  }
  json manifest() const { return readManifest(path_); }
  void setManifest(const json& manifest) { writeFileAtomically(path_ / "manifest.json", manifest.dump()); }
  template <class Spoil>
  void spoilLayers(Spoil spoil) {
    json open = manifest();
    open.erase("files");
    setManifest(open);
    std::vector<ExrLayer> layers = readExr(path_ / "moments.exr");
    spoil(layers);
    writeExr(path_ / "moments.exr", layers, ExrCompression::none);
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "room.dlm";
};

TEST_F(HostileMoments, MissingTruncatedLengthenedAndAlteredFilesAreNamed) {
  const std::filesystem::path file = path_ / "moments.exr";
  const std::vector<std::uint8_t> whole = readFile(file);
  std::filesystem::remove(file);
  expectRefused("moments.exr");
  for (const std::size_t size : {std::size_t{0}, whole.size() / 2, whole.size() - 2}) {
    writeFileAtomically(file, std::span(whole).first(size));
    expectRefused("moments.exr");
  }
  std::vector<std::uint8_t> other = whole;
  other.push_back(0);
  writeFileAtomically(file, other);
  expectRefused("moments.exr");
  other = whole;
  other[other.size() - 3] ^= 1;
  writeFileAtomically(file, other);
  expectRefused("moments.exr");
  writeFileAtomically(file, whole);
  EXPECT_NO_THROW(readDlm(path_));
}

TEST_F(HostileMoments, NumbersThatNoMeanHasAreRefused) {
  spoilLayers([](std::vector<ExrLayer>& layers) {
    for (ExrLayer& l : layers) std::fill(l.channels[0].uints.begin(), l.channels[0].uints.end(), 0xffffffffu);
  });
  expectRefused("no mean direction");
}

TEST_F(HostileMoments, AnyCodeIsAVectorNoLongerThanOne) {
  spoilLayers([](std::vector<ExrLayer>& layers) {
    for (ExrLayer& l : layers) std::fill(l.channels[0].uints.begin(), l.channels[0].uints.end(), 0x3fffffffu);
  });
  for (const Vec3f& m : readDlm(path_).maps.meanDirections) EXPECT_LE(dot(m, m), 1.00001f);
}

TEST_F(HostileMoments, LayersOfAnotherSizeNameOrKindAreRefused) {
  spoilLayers([](std::vector<ExrLayer>& layers) { layers.pop_back(); });
  expectRefused("has no layer");
}

TEST_F(HostileMoments, ChannelsOfRealNumbersAreRefused) {
  spoilLayers([](std::vector<ExrLayer>& layers) {
    for (ExrLayer& l : layers) {
      l.channels[0].floats.assign(l.channels[0].uints.size(), 0.5f);
      l.channels[0].uints.clear();
      l.channels[0].type = ChannelType::float32;
    }
  });
  expectRefused("MEAN");
}

TEST_F(HostileMoments, SmallerPagesAreRefused) {
  spoilLayers([](std::vector<ExrLayer>& layers) {
    for (ExrLayer& l : layers) {
      --l.height;
      l.channels[0].uints.resize(static_cast<std::size_t>(l.width) * static_cast<std::size_t>(l.height));
    }
  });
  expectRefused("as the manifest says");
}

TEST_F(HostileMoments, AManifestThatSaysNonsenseOfThemIsRefused) {
  for (const json& means : {json("moments.exr"), json::array(), json{{"reach", "far"}}, json{{"reach", 7}}, json::object()}) {
    json m = manifest();
    m["directional"]["means"] = means;
    setManifest(m);
    expectRefused("means");
  }
}

}  // namespace
}  // namespace lucarne::moments_file_test
