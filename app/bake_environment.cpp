#include "app/bake_environment.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"

namespace lucarne {
namespace {

/// By whole columns, so that no value is changed. Columns to the right turn from +x to +z, clockwise from above.
void turn(ImageRgb& image, double degrees) {
  const double turns = degrees / 360 - std::floor(degrees / 360);
  const auto shift = static_cast<int>(turns * image.width + 0.5) % image.width;
  for (int y = 0; y < image.height; ++y) {
    const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width;
    std::rotate(row, row + shift, row + image.width);
  }
}

constexpr std::size_t kHead = 8;

}  // namespace

ImageRgb loadSky(const BakeOptions& options) {
  if (!options.environment) return {};
  const std::filesystem::path& path = *options.environment;
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".exr" && ending != ".hdr")
    throw UsageError(path.string() + ": an environment is an .exr or .hdr file");
  ImageRgb image = ending == ".exr" ? readExrRgb(path) : readHdr(path);
  if (image.pixels.empty()) throw InputError(path.string() + " has no pixels");
  if (options.environmentTurn != 0) turn(image, options.environmentTurn);
  const auto scale = static_cast<float>(options.environmentScale);
  if (scale != 1) {
    for (Rgb& p : image.pixels) p *= scale;
  }
  return image;
}

std::vector<std::uint8_t> packSky(const ImageRgb& image) {
  std::vector<std::uint8_t> bytes(kHead + image.pixels.size() * sizeof(Rgb));
  const std::array<std::int32_t, 2> size{image.width, image.height};
  std::memcpy(bytes.data(), size.data(), kHead);
  if (!image.pixels.empty()) std::memcpy(bytes.data() + kHead, image.pixels.data(), image.pixels.size() * sizeof(Rgb));
  return bytes;
}

ImageRgb unpackSky(const std::vector<std::uint8_t>& bytes) {
  std::array<std::int32_t, 2> size{};
  if (bytes.size() >= kHead) std::memcpy(size.data(), bytes.data(), kHead);
  const std::uint64_t pixels =
      size[0] < 0 || size[1] < 0 ? kMaxPixels + 1 : std::uint64_t(size[0]) * std::uint64_t(size[1]);
  if (pixels > kMaxPixels || bytes.size() != kHead + pixels * sizeof(Rgb))
    throw InputError("the environment arrived damaged");
  ImageRgb image{size[0], size[1], {}};
  image.pixels.resize(pixels);
  if (pixels > 0) std::memcpy(image.pixels.data(), bytes.data() + kHead, pixels * sizeof(Rgb));
  return image;
}

std::unique_ptr<Environment> makeEnvironment(ImageRgb image, const BakeOptions& options) {
  if (image.pixels.empty()) return nullptr;
  return std::make_unique<Environment>(std::move(image), environmentName(options));
}

std::string environmentName(const BakeOptions& options) {
  return options.environment ? options.environment->filename().string() : std::string();
}

}  // namespace lucarne
