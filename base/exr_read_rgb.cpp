// The picture of an OpenEXR file's first layer, scanlines or tiles, put where it belongs in the display window.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>

#include "base/error.h"
#include "base/exr_open.h"
#include "base/image_file.h"
#include "base/image_size.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
using Window = IMATH_NAMESPACE::Box2i;

ImageRgb blackImage(const Window& window) {
  const WindowSize size = sizeOf(window);
  ImageRgb image{static_cast<int>(size.width), static_cast<int>(size.height), {}};
  image.pixels.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  return image;
}

/// The pixels of the data window. Of a tiled layer, these are the tiles of its largest level.
ImageRgb readDataWindow(const std::string& name, imf::MultiPartInputFile& input) {
  const imf::ChannelList& channels = input.header(0).channels();
  const Window window = input.header(0).dataWindow();
  const bool isGrey = channels.findChannel("R") == nullptr && channels.findChannel("Y") != nullptr;
  ImageRgb image = blackImage(window);
  imf::FrameBuffer frame;
  for (int c = 0; c < (isGrey ? 1 : 3); ++c) {
    const std::string channel(1, isGrey ? 'Y' : "RGB"[c]);
    const imf::Channel* stored = channels.findChannel(channel);
    if (stored == nullptr || stored->type == imf::UINT) {
      throw InputError(name + ": no channels R, G, B (or Y) of real numbers in its first layer");
    }
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    float* const values = &image.pixels.front().x + c;
    frame.insert(channel, imf::Slice::Make(imf::FLOAT, values, window, sizeof(Rgb)));
  }
  imf::InputPart part(input, 0);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  if (isGrey) {
    for (Rgb& pixel : image.pixels) pixel = Rgb(pixel.x);
  }
  return image;
}

/// What the display window shows of `data`, black where there is none.
ImageRgb placed(const ImageRgb& data, const Window& dataWindow, const Window& display) {
  ImageRgb image = blackImage(display);
  const std::int64_t left = std::int64_t{dataWindow.min.x} - display.min.x;
  const std::int64_t top = std::int64_t{dataWindow.min.y} - display.min.y;
  const std::int64_t x0 = std::max<std::int64_t>(left, 0), x1 = std::min<std::int64_t>(left + data.width, image.width);
  const std::int64_t y0 = std::max<std::int64_t>(top, 0), y1 = std::min<std::int64_t>(top + data.height, image.height);
  if (x0 >= x1) return image;
  for (std::int64_t y = y0; y < y1; ++y) {
    std::copy_n(data.pixels.begin() + ((y - top) * data.width + x0 - left), x1 - x0,
                image.pixels.begin() + (y * image.width + x0));
  }
  return image;
}

}  // namespace

ImageRgb readExrRgb(const std::filesystem::path& path) {
  ImageRgb image;
  const std::string name = path.string();
  withExr(path, ExrTiles::read, [&](imf::MultiPartInputFile& input, const InputFile& file) {
    const Window data = input.header(0).dataWindow(), display = input.header(0).displayWindow();
    const WindowSize size = sizeOf(display);
    checkImageSize(name, size.width, size.height, sizeof(Rgb), file.size());
    image = readDataWindow(name, input);
    if (data != display) image = placed(image, data, display);
  });
  return image;
}

}  // namespace lucarne
