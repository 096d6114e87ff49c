// The collected environment maps and malformed pictures: each loads or is refused with an InputError, within bounded
// memory.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>

#include "base/files.h"
#include "base/image_file.h"
#include "tests/base/expect_error.h"

namespace lucarne::asset_images_test {
namespace {

namespace fs = std::filesystem;

const fs::path kAssets = fs::path(LUCARNE_SOURCE_DIR) / "../shared/assets";

std::vector<fs::path> picturesIn(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".exr" || extension == ".hdr") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

ImageRgb readPicture(const fs::path& path) { return path.extension() == ".hdr" ? readHdr(path) : readExrRgb(path); }

double peakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

TEST(AssetImages, EnvironmentMapsLoadTiledOnesToo) {
  if (!fs::exists(kAssets / "env")) GTEST_SKIP() << "shared/assets/env is not here";
  for (const fs::path& path : picturesIn(kAssets / "env")) {
    const ImageRgb image = readPicture(path);
    EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width * image.height)) << path;
    EXPECT_GE(image.width, 512) << path;
  }
}

TEST(AssetImages, TheSameMapAsRadianceAndOpenExrHasTheSameMean) {
  if (!fs::exists(kAssets / "env")) GTEST_SKIP() << "shared/assets/env is not here";
  Rgbd means[2];
  int k = 0;
  for (const char* name : {"beach_sun_spiaggia_di_mondello_1k.hdr", "beach_sun_512_zip_half.exr"}) {
    const ImageRgb image = readPicture(kAssets / "env" / name);
    for (const Rgb& pixel : image.pixels) means[k] += Rgbd(pixel);
    means[k] *= 1.0 / static_cast<double>(image.pixels.size());
    ++k;
  }
  // The second is a 2 x 2 box average stored as half: 11 bits, rounded to nearest.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(means[1][c] / means[0][c], 1, 1.0 / 2048);
}

TEST(AssetImages, MalformedOnesNeverCrashNorTakeMuchMemory) {
  if (!fs::exists(kAssets / "malformed")) GTEST_SKIP() << "shared/assets/malformed is not here";
  const std::vector<fs::path> paths = picturesIn(kAssets / "malformed");
  ASSERT_GT(paths.size(), 20u);
  const double before = peakMebibytes();
  int refused = 0;
  for (const fs::path& path : paths) {
    for (const bool all : {false, true}) {
      if (all && path.extension() == ".hdr") continue;
      try {
        if (all) {
          readExr(path);
        } else {
          readPicture(path);
          ADD_FAILURE() << path << " was read as a picture";
        }
      } catch (const InputError& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(refused, 40);
  EXPECT_LT(peakMebibytes() - before, 300);
}

}  // namespace
}  // namespace lucarne::asset_images_test
