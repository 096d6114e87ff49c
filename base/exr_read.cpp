#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/error.h"
#include "base/exr_header_scan.h"
#include "base/exr_stream.h"
#include "base/image_file.h"
#include "base/image_size.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;

/// Rows that the library decodes at once, and so allocates even for an image of one row.
std::int64_t rowsInChunk(imf::Compression compression) {
  switch (compression) {
    case imf::NO_COMPRESSION:
    case imf::RLE_COMPRESSION:
    case imf::ZIPS_COMPRESSION:
      return 1;
    case imf::ZIP_COMPRESSION:
    case imf::PXR24_COMPRESSION:
      return 16;
    case imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 32;
  }
}

struct WindowSize {
  std::int64_t width, height;
};

WindowSize sizeOf(const imath::Box2i& window) {
  return {std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1};
}

/// What the decoded channels of one layer take, checked against what the file can hold. Returns bytes.
std::uint64_t checkLayerSize(const std::string& name, const imf::Header& header, std::uint64_t fileBytes) {
  std::uint64_t channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    ++channels;
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
      throw InputError(name + ": the channel \"" + it.name() + "\" is subsampled; save it as plain RGB");
    }
  }
  if (channels == 0) throw InputError(name + ": a layer has no channels");
  const WindowSize size = sizeOf(header.dataWindow());
  const std::int64_t rows = rowsInChunk(header.compression());
  checkImageSize(name, size.width, size.height, channels * sizeof(float), fileBytes);
  checkImageSize(name, size.width, (size.height + rows - 1) / rows * rows, channels * sizeof(float), fileBytes);
  return channels * sizeof(float) * static_cast<std::uint64_t>(size.width * size.height);
}

void checkSizes(const std::string& name, const imf::MultiPartInputFile& input, std::uint64_t fileBytes) {
  std::uint64_t total = 0;
  for (int part = 0; part < input.parts(); ++part) {
    const imf::Header& header = input.header(part);
    if (header.hasType() && header.type() != imf::SCANLINEIMAGE) {
      throw InputError(name + ": a layer is of the kind " + header.type() +
                       ", which is not read; save it as scanlines");
    }
    total += checkLayerSize(name, header, fileBytes);
  }
  if (total / 4 > kMaxPixels * 4) throw InputError(name + ": its layers have too many pixels together");
  checkImageSize(name, 1, static_cast<std::int64_t>(total / 4), sizeof(float), fileBytes);
}

ExrLayer emptyLayer(const imf::Header& header) {
  ExrLayer layer;
  const WindowSize size = sizeOf(header.dataWindow());
  layer.width = static_cast<int>(size.width);
  layer.height = static_cast<int>(size.height);
  if (header.hasName()) layer.name = header.name();
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string key = it.name();
    const auto* text = dynamic_cast<const imf::StringAttribute*>(&it.attribute());
    if (text != nullptr && key != "name" && key != "type") layer.attributes[key] = text->value();
  }
  return layer;
}

ExrLayer readLayer(imf::MultiPartInputFile& input, int index) {
  const imf::Header& header = input.header(index);
  const imath::Box2i window = header.dataWindow();
  ExrLayer layer = emptyLayer(header);
  const std::size_t pixels = static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height);
  imf::FrameBuffer frame;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    ExrChannel channel;
    channel.name = it.name();
    const imf::PixelType type = it.channel().type;
    channel.type = type == imf::UINT   ? ChannelType::uint32
                   : type == imf::HALF ? ChannelType::half
                                       : ChannelType::float32;
    void* values = nullptr;
    if (type == imf::UINT) {
      channel.uints.resize(pixels);
      values = channel.uints.data();
    } else {
      channel.floats.resize(pixels);
      values = channel.floats.data();
    }
    frame.insert(channel.name, imf::Slice::Make(type == imf::UINT ? imf::UINT : imf::FLOAT, values, window));
    layer.channels.push_back(std::move(channel));  // moving keeps the address of the values
  }
  imf::InputPart part(input, index);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  return layer;
}

/// Calls `use` on the opened and checked file, and turns the library's exceptions into ours.
template <class Use>
void withExr(const std::filesystem::path& path, Use use) {
  const InputFile file(path);
  const std::string name = path.string();
  try {
    scanExrHeader(file);
    ExrInputStream stream(file);
    // No reconstruction of a missing table of offsets: an unfinished file is an error here.
    imf::MultiPartInputFile input(stream, 0, false);
    checkSizes(name, input, file.size());
    use(input);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::outOfResource, "not enough memory to read " + name);
  } catch (const std::exception& error) {
    throw InputError(name + " is not a usable OpenEXR file: " + exrReason(error, name));
  }
}

void checkWholeImage(const std::string& name, const imf::Header& header) {
  if (header.dataWindow() != header.displayWindow()) {
    throw InputError(name + ": its data window is not its display window (a cropped image); save it uncropped");
  }
}

}  // namespace

const ExrChannel* ExrLayer::find(const std::string& channel) const {
  for (const ExrChannel& candidate : channels) {
    if (candidate.name == channel) return &candidate;
  }
  return nullptr;
}

std::vector<ExrLayer> readExr(const std::filesystem::path& path) {
  std::vector<ExrLayer> layers;
  withExr(path, [&](imf::MultiPartInputFile& input) {
    for (int part = 0; part < input.parts(); ++part) layers.push_back(readLayer(input, part));
  });
  return layers;
}

ImageRgb readExrRgb(const std::filesystem::path& path) {
  ExrLayer layer;
  withExr(path, [&](imf::MultiPartInputFile& input) {
    checkWholeImage(path.string(), input.header(0));
    layer = readLayer(input, 0);
  });
  const bool isGrey = layer.find("R") == nullptr && layer.find("Y") != nullptr;
  const ExrChannel* sources[3];
  const char* const names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    sources[c] = layer.find(isGrey ? "Y" : names[c]);
    if (sources[c] == nullptr || sources[c]->type == ChannelType::uint32) {
      throw InputError(path.string() + ": no channels R, G, B (or Y) of real numbers in its first layer");
    }
  }
  ImageRgb image{layer.width, layer.height, {}};
  image.pixels.reserve(sources[0]->floats.size());
  for (std::size_t i = 0; i < sources[0]->floats.size(); ++i) {
    image.pixels.emplace_back(sources[0]->floats[i], sources[1]->floats[i], sources[2]->floats[i]);
  }
  return image;
}

}  // namespace lucarne
