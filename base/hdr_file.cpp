// Radiance RGBE pictures (Ward, "Real Pixels", Graphics Gems II): a text header, then scanlines that are flat,
// run-length coded a byte plane at a time ("new"), or flat with repeat marks ("old").
#include <bit>
#include <charconv>
#include <string_view>

#include "base/error.h"
#include "base/files.h"
#include "base/image_file.h"
#include "base/image_size.h"
#include "base/math.h"

namespace lucarne {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class HdrReader {
 public:
  HdrReader(const std::vector<std::uint8_t>& bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  ImageRgb read() {
    readHeader();
    ImageRgb image;
    readResolution(image);
    checkImageSize(name_, image.width, image.height, sizeof(Rgb), bytes_.size());
    std::vector<Rgbe> line(static_cast<std::size_t>(image.width));
    image.pixels.reserve(line.size() * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) {
      readLine(line);
      for (const Rgbe& pixel : line) image.pixels.push_back(decode(pixel));
    }
    return image;
  }

 private:
  std::string readTextLine() {
    constexpr std::size_t kLongestLine = 4096;
    std::string line;
    for (std::uint8_t c = readByte(); c != '\n'; c = readByte()) {
      if (line.size() == kLongestLine) refuse("a line of its header does not end");
      line += static_cast<char>(c);
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  void readHeader() {
    if (bytes_.size() < 2 || bytes_[0] != '#' || bytes_[1] != '?') refuse("it is not a Radiance HDR file");
    readTextLine();
    for (std::string line = readTextLine(); !line.empty(); line = readTextLine()) {
      constexpr std::string_view kFormat = "FORMAT=", kExposure = "EXPOSURE=";
      if (line.starts_with(kFormat) && line.substr(kFormat.size()) != "32-bit_rle_rgbe") {
        refuse("its format is " + line.substr(kFormat.size()) + ", only 32-bit_rle_rgbe is read; convert it to RGB");
      }
      if (line.starts_with(kExposure)) divideByExposure(line.substr(kExposure.size()));
    }
  }

  /// Pixels were multiplied by all the exposures named before they were stored.
  void divideByExposure(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    double exposure = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), exposure);
    if (result.ec != std::errc{} || !(exposure > 1e-30 && exposure < 1e30))
      refuse("its EXPOSURE is not a positive number");
    scale_ /= exposure;
    if (!(scale_ > 1e-60 && scale_ < 1e60)) refuse("its EXPOSUREs are beyond all measure");
  }

  void readResolution(ImageRgb& image) {
    const std::string line = readTextLine();
    const char* at = line.data();
    const char* const end = line.data() + line.size();
    const auto number = [&](std::string_view label, int& value) {
      if (!std::string_view(at, end).starts_with(label)) return false;
      const auto result = std::from_chars(at + label.size(), end, value);
      at = result.ptr;
      return result.ec == std::errc{};
    };
    if (!number("-Y ", image.height) || !number(" +X ", image.width) || at != end) {
      refuse("its resolution line is not \"-Y height +X width\" (top row first)");
    }
  }

  std::uint8_t readByte() {
    if (at_ == bytes_.size()) refuse("it is cut short");
    return bytes_[at_++];
  }

  Rgbe readPixel() {
    Rgbe pixel;
    for (std::uint8_t& byte : pixel) byte = readByte();
    return pixel;
  }

  void readLine(std::vector<Rgbe>& line) {
    const Rgbe first = readPixel();
    const bool mayBePlanes = line.size() >= 8 && line.size() < 0x8000;  // otherwise (2, 2, …) is a colour
    const bool planes = mayBePlanes && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!planes) return readFlatLine(first, line);
    if ((std::size_t{first[2]} << 8 | first[3]) != line.size()) refuse("a scanline has another width than the image");
    for (std::size_t plane = 0; plane < 4; ++plane) readPlane(line, plane);
  }

  void readPlane(std::vector<Rgbe>& line, std::size_t plane) {
    std::size_t x = 0;
    while (x < line.size()) {
      const std::uint8_t code = readByte();
      const bool isRun = code > 128;
      const std::size_t count = isRun ? code - 128u : code;
      if (count == 0 || count > line.size() - x) refuse("a run of pixels is damaged");
      std::uint8_t value = isRun ? readByte() : 0;
      for (std::size_t end = x + count; x < end; ++x) {
        if (!isRun) value = readByte();
        line[x][plane] = value;
      }
    }
  }

  /// A pixel (1, 1, 1, n) repeats the one before n times; several in a row are the bytes of n, lowest first.
  void readFlatLine(Rgbe pixel, std::vector<Rgbe>& line) {
    std::size_t x = 0;
    unsigned shift = 0;
    for (;;) {
      const bool isRepeat = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
      if (isRepeat) {
        if (x == 0 || shift > 16) refuse("a run of pixels is damaged");
        const std::size_t count = std::size_t{pixel[3]} << shift;
        if (count > line.size() - x) refuse("a run of pixels is damaged");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
        x += count;
        shift += 8;
      } else {
        line[x++] = pixel;
        shift = 0;
      }
      if (x == line.size()) return;
      pixel = readPixel();
    }
  }

  Rgb decode(const Rgbe& pixel) const {
    if (pixel[3] == 0) return {};
    const double unit = powerOfTwo(int{pixel[3]} - 136) * scale_;
    return Rgb(Rgbd(pixel[0] * unit, pixel[1] * unit, pixel[2] * unit));
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw InputError("cannot read " + name_ + ": " + reason);
  }

  const std::vector<std::uint8_t>& bytes_;
  std::string name_;
  std::size_t at_ = 0;
  double scale_ = 1;
};

}  // namespace

ImageRgb readHdr(const std::filesystem::path& path) { return HdrReader(readFile(path), path.string()).read(); }

}  // namespace lucarne
