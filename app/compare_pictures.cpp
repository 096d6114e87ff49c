#include <algorithm>
#include <cmath>

#include "app/compare_kinds.h"
#include "app/difference.h"
#include "base/error.h"
#include "base/files.h"
#include "base/flip.h"
#include "base/heat_colour.h"
#include "base/image_file.h"
#include "base/math.h"

namespace lucarne {
namespace {

/// RGB of a file. `codes`: the values that a display is sent, 0 … 1; else linear.
struct Picture {
  ImageRgb image;
  bool codes = false;
};

Picture readPicture(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".exr") return {readExrRgb(path), false};
  if (ending == ".hdr") return {readHdr(path), false};
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg") {
    throw InputError(path.string() + ": not a picture that compare knows: .png, .jpg, .exr or .hdr");
  }
  const DecodedImage decoded = decodeImage(readFile(path), path.string());
  Picture picture{{decoded.width, decoded.height, {}}, true};
  picture.image.pixels.reserve(decoded.rgba.size() / 4);
  for (std::size_t i = 0; i < decoded.rgba.size(); i += 4) {
    picture.image.pixels.push_back({static_cast<float>(decoded.rgba[i]) / 255,
                                    static_cast<float>(decoded.rgba[i + 1]) / 255,
                                    static_cast<float>(decoded.rgba[i + 2]) / 255});
  }
  return picture;
}

ImageRgb decoded(const ImageRgb& codes) {
  ImageRgb linear = codes;
  for (Rgb& p : linear.pixels) {
    for (int i = 0; i < 3; ++i) p[i] = static_cast<float>(srgbToLinear(static_cast<double>(p[i])));
  }
  return linear;
}

/// Mean of (B − A)² / (A² + ε²) over finite pixels and channels; ε is a hundredth of A's mean, so that dark pixels
/// count, but no dark pixel decides all.
double relativeMse(const ImageRgb& a, const ImageRgb& b, double meanA) {
  const double epsilon = 0.01 * meanA;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (!isFinite(a.pixels[i]) || !isFinite(b.pixels[i])) continue;
    for (int k = 0; k < 3; ++k) {
      const auto va = static_cast<double>(a.pixels[i][k]), vb = static_cast<double>(b.pixels[i][k]);
      sum += (vb - va) * (vb - va) / (va * va + epsilon * epsilon);
      ++count;
    }
  }
  return sum / count;
}

/// Where the largest difference is, and how many pixels have none because they are not finite.
void describePixels(const ImageRgb& a, const ImageRgb& b, nlohmann::json& d) {
  DifferenceSum sum;
  std::size_t worst = 0;
  std::uint64_t broken = 0;
  double largest = -1;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgbd pa(a.pixels[i]), pb(b.pixels[i]);
    if (!isFinite(pa) || !isFinite(pb)) {
      ++broken;
      continue;
    }
    sum.add(1, pa, pb);
    const double difference = largestDifference(pa, pb);
    if (difference > largest) largest = difference, worst = i;
  }
  d.update(toJson(sum, ""));
  d["relative_mse"] = sum.empty() ? nlohmann::json() : finiteOrNull(relativeMse(a, b, mean(sum.meanA())));
  d["non_finite_pixels"] = broken;
  d["largest"] = nullptr;
  if (sum.empty()) return;
  const auto width = static_cast<std::size_t>(a.width);
  d["largest"] = {{"pixel", {worst % width, worst / width}},
                  {"a", toJson(Vec3d(a.pixels[worst]))},
                  {"b", toJson(Vec3d(b.pixels[worst]))}};
}

FlipMap flipOf(const Picture& a, const Picture& b, nlohmann::json& d) {
  FlipMap map;
  if (a.codes) {
    map = flipLdr(decoded(a.image), decoded(b.image));
    d["flip"] = {{"kind", "LDR"}};
  } else {
    const FlipExposures e = flipExposures(a.image);
    map = flipHdr(a.image, b.image, e);
    d["flip"] = {
        {"kind", "HDR"}, {"exposures", e.count}, {"first_exposure_stops", e.start}, {"last_exposure_stops", e.stop}};
  }
  d["flip"]["mean"] = map.mean();
  d["flip"]["largest"] = map.largest();
  d["flip"]["pixels_per_degree"] = kFlipPixelsPerDegree;
  return map;
}

void writeFlip(const std::filesystem::path& path, const FlipMap& map) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(map.error.size() * 3);
  for (const float e : map.error) {
    for (const std::uint8_t code : heatColour(static_cast<double>(e))) bytes.push_back(code);
  }
  writePng(path, map.width, map.height, bytes);
}

std::string sizeOf(const ImageRgb& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

void checkPair(const CompareOptions& o, const Picture& a, const Picture& b) {
  if (a.codes != b.codes) {
    throw UsageError((a.codes ? o.b : o.a).string() + " holds linear light, " + (a.codes ? o.a : o.b).string() +
                     " what a display is sent: compare pictures of the same kind of file");
  }
  if (a.image.width != b.image.width || a.image.height != b.image.height) {
    throw InputError(o.a.string() + " has " + sizeOf(a.image) + " pixels, " + o.b.string() + " has " + sizeOf(b.image) +
                     ": only pictures of one size can be compared");
  }
}

}  // namespace

nlohmann::json comparePictures(const CompareOptions& options) {
  if (!options.picture.empty()) {
    if (options.picture.extension() != ".png") throw UsageError(options.picture.string() + ": --picture writes a .png");
    checkWritable(options.picture);
  }
  const Picture a = readPicture(options.a), b = readPicture(options.b);
  checkPair(options, a, b);
  nlohmann::json d = {{"kind", "pictures"},
                      {"width", a.image.width},
                      {"height", a.image.height},
                      {"values", a.codes ? "display codes, 0 to 1" : "linear, as in the files"}};
  describePixels(a.image, b.image, d);
  const FlipMap map = flipOf(a, b, d);
  if (!options.picture.empty()) writeFlip(options.picture, map);
  return d;
}

}  // namespace lucarne
