#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <list>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/exr_stream.h"
#include "base/image_file.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;

imf::Compression exrCompression(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::none:
      return imf::NO_COMPRESSION;
    case ExrCompression::rle:
      return imf::RLE_COMPRESSION;
    case ExrCompression::zips:
      return imf::ZIPS_COMPRESSION;
  }
  throw std::logic_error("unknown EXR compression");
}

imf::PixelType exrType(ChannelType type) {
  switch (type) {
    case ChannelType::half:
      return imf::HALF;
    case ChannelType::float32:
      return imf::FLOAT;
    case ChannelType::uint32:
      return imf::UINT;
  }
  throw std::logic_error("unknown EXR channel type");
}

/// Windows start at the origin; the display window is the largest of all layers, because a file has only one.
imf::Header layerHeader(const ExrLayer& layer, const imath::Box2i& displayWindow, imf::Compression compression) {
  const imath::Box2i dataWindow(imath::V2i(0, 0), imath::V2i(layer.width - 1, layer.height - 1));
  imf::Header header(displayWindow, dataWindow, 1.0f, imath::V2f(0, 0), 1.0f, imf::INCREASING_Y, compression);
  if (!layer.name.empty()) {
    header.setName(layer.name);
    header.setType(imf::SCANLINEIMAGE);
  }
  for (const ExrChannel& channel : layer.channels) {
    header.channels().insert(channel.name, imf::Channel(exrType(channel.type)));
  }
  for (const auto& [key, text] : layer.attributes) header.insert(key, imf::StringAttribute(text));
  return header;
}

std::vector<imf::Header> layerHeaders(const std::vector<ExrLayer>& layers, ExrCompression compression) {
  imath::Box2i displayWindow;
  for (const ExrLayer& layer : layers) {
    displayWindow.extendBy(imath::V2i(0, 0));
    displayWindow.extendBy(imath::V2i(layer.width - 1, layer.height - 1));
  }
  std::vector<imf::Header> headers;
  headers.reserve(layers.size());
  for (const ExrLayer& layer : layers) {
    headers.push_back(layerHeader(layer, displayWindow, exrCompression(compression)));
  }
  return headers;
}

/// A finite value stays finite: one beyond the range of half becomes its largest, not infinity.
half toHalf(float value) {
  constexpr float kLargestHalf = 65504.0f;
  return half(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value);
}

void checkLayer(const ExrLayer& layer) {
  LUCARNE_CHECK_LT(0, layer.width);
  LUCARNE_CHECK_LT(0, layer.height);
  const std::size_t pixels = static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height);
  for (const ExrChannel& channel : layer.channels) {
    const bool isUint = channel.type == ChannelType::uint32;
    LUCARNE_CHECK_EQ(channel.uints.size(), isUint ? pixels : 0);
    LUCARNE_CHECK_EQ(channel.floats.size(), isUint ? 0 : pixels);
  }
}

/// OpenEXR takes pointers to mutable data for reading and writing alike; it does not change what it writes.
template <class T>
imf::Slice outputSlice(imf::PixelType type, const std::vector<T>& values, int width) {
  char* base = const_cast<char*>(reinterpret_cast<const char*>(values.data()));
  return imf::Slice(type, base, sizeof(T), sizeof(T) * static_cast<std::size_t>(width));
}

template <class Output>
void writeLayer(Output&& output, const ExrLayer& layer) {
  imf::FrameBuffer frame;
  std::list<std::vector<half>> halves;  // lives until the pixels are written
  for (const ExrChannel& channel : layer.channels) {
    if (channel.type == ChannelType::uint32) {
      frame.insert(channel.name, outputSlice(imf::UINT, channel.uints, layer.width));
    } else if (channel.type == ChannelType::float32) {
      frame.insert(channel.name, outputSlice(imf::FLOAT, channel.floats, layer.width));
    } else {
      std::vector<half>& values = halves.emplace_back(channel.floats.size());
      std::transform(channel.floats.begin(), channel.floats.end(), values.begin(), toHalf);
      frame.insert(channel.name, outputSlice(imf::HALF, values, layer.width));
    }
  }
  output.setFrameBuffer(frame);
  output.writePixels(layer.height);
}

void writeLayers(ExrOutputStream& stream, const std::vector<ExrLayer>& layers,
                 const std::vector<imf::Header>& headers) {
  if (layers.size() == 1 && layers[0].name.empty()) {
    writeLayer(imf::OutputFile(stream, headers[0], 0), layers[0]);
    return;
  }
  imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()), false, 0);
  for (std::size_t i = 0; i < layers.size(); ++i) writeLayer(imf::OutputPart(output, static_cast<int>(i)), layers[i]);
}

}  // namespace

void writeExr(const std::filesystem::path& path, const std::vector<ExrLayer>& layers, ExrCompression compression) {
  LUCARNE_CHECK_LT(std::size_t{0}, layers.size());
  for (const ExrLayer& layer : layers) checkLayer(layer);
  AtomicFile file(path);
  ExrOutputStream stream(file, path.string());
  try {
    writeLayers(stream, layers, layerHeaders(layers, compression));
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::outOfResource, "not enough memory to write " + path.string());
  } catch (const std::exception& error) {
    stream.rethrowFailure();
    throw Error(ExitCode::failed, "cannot write " + path.string() + ": " + exrReason(error, path.string()));
  }
  stream.rethrowFailure();
  file.commit();
}

void writeExrRgb(const std::filesystem::path& path, const ImageRgb& image) {
  ExrLayer layer;
  layer.width = image.width;
  layer.height = image.height;
  const char* const names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    ExrChannel& channel = layer.channels.emplace_back();
    channel.name = names[c];
    channel.floats.reserve(image.pixels.size());
    for (const Rgb& pixel : image.pixels) channel.floats.push_back(pixel[c]);
  }
  writeExr(path, {layer}, ExrCompression::zips);
}

}  // namespace lucarne
