#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/exr_layers.h"
#include "base/exr_open.h"
#include "base/exr_stream.h"
#include "base/image_file.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;

ChannelType typeOf(imf::PixelType type) {
  return type == imf::UINT ? ChannelType::uint32 : type == imf::HALF ? ChannelType::half : ChannelType::float32;
}

/// All but the values.
ExrLayer headOf(const imf::Header& header) {
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
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    layer.channels.push_back({it.name(), typeOf(it.channel().type), {}, {}});
  return layer;
}

std::vector<ExrLayer> headsOf(const imf::MultiPartInputFile& input) {
  std::vector<ExrLayer> heads;
  for (int part = 0; part < input.parts(); ++part) heads.push_back(headOf(input.header(part)));
  return heads;
}

/// Fills the channels of a layer whose head is that of the part.
void readValues(imf::MultiPartInputFile& input, int index, ExrLayer& layer) {
  const imath::Box2i window = input.header(index).dataWindow();
  const std::size_t pixels = static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height);
  imf::FrameBuffer frame;
  for (ExrChannel& channel : layer.channels) {
    const bool whole = channel.type == ChannelType::uint32;
    void* values = nullptr;
    if (whole) {
      channel.uints.resize(pixels);
      values = channel.uints.data();
    } else {
      channel.floats.resize(pixels);
      values = channel.floats.data();
    }
    frame.insert(channel.name, imf::Slice::Make(whole ? imf::UINT : imf::FLOAT, values, window));
  }
  imf::InputPart part(input, index);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
}

bool sameShape(const ExrLayer& a, const ExrLayer& b) {
  const auto sameChannel = [](const ExrChannel& x, const ExrChannel& y) { return x.name == y.name && x.type == y.type; };
  return a.width == b.width && a.height == b.height &&
         std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(), sameChannel);
}

/// One thread's look at the file. The library locks a file that it reads, so that threads that share one wait for each
/// other.
class Reader {
 public:
  explicit Reader(const InputFile& file) : name_(file.path().string()), stream_(file), input_(stream_, 0, false) {}

  const ExrLayer& read(std::size_t index, const ExrLayer& head) {
    const int part = static_cast<int>(index);
    // The file was checked when another look at it began.
    if (part >= input_.parts() || !sameShape(headOf(input_.header(part)), head))
      throw InputError(name_ + ": was altered while it was read");
    takeShape(head);
    readValues(input_, part, layer_);
    return layer_;
  }

 private:
  /// The memory of the layer before serves again: fresh memory costs more time than what is read into it.
  void takeShape(const ExrLayer& head) {
    std::vector<ExrChannel> before = std::move(layer_.channels);
    layer_ = head;
    for (std::size_t i = 0; i < std::min(before.size(), layer_.channels.size()); ++i) {
      layer_.channels[i].floats = std::move(before[i].floats);
      layer_.channels[i].uints = std::move(before[i].uints);
      (layer_.channels[i].type == ChannelType::uint32 ? layer_.channels[i].floats.clear() : layer_.channels[i].uints.clear());
    }
  }

  std::string name_;
  ExrInputStream stream_;
  imf::MultiPartInputFile input_;
  ExrLayer layer_;
};

}  // namespace

const ExrChannel* ExrLayer::find(const std::string& channel) const {
  for (const ExrChannel& candidate : channels) {
    if (candidate.name == channel) return &candidate;
  }
  return nullptr;
}

std::vector<ExrLayer> readExr(const std::filesystem::path& path) {
  std::vector<ExrLayer> layers;
  withExr(path, ExrTiles::refused, [&](imf::MultiPartInputFile& input, const InputFile&) {
    layers = headsOf(input);
    for (std::size_t i = 0; i < layers.size(); ++i) readValues(input, static_cast<int>(i), layers[i]);
  });
  return layers;
}

void readExrLayers(const std::filesystem::path& path, const ExrLayerUse& use) {
  withExr(path, ExrTiles::refused, [&](imf::MultiPartInputFile& input, const InputFile& file) {
    const std::vector<ExrLayer> heads = headsOf(input);
    const std::vector<bool> wanted = use.choose(heads);
    tbb::enumerable_thread_specific<std::unique_ptr<Reader>> readers;
    tbb::parallel_for(std::size_t{0}, heads.size(), [&](std::size_t i) {
      if (!wanted[i]) return;
      std::unique_ptr<Reader>& reader = readers.local();
      if (!reader) reader = std::make_unique<Reader>(file);
      use.take(i, reader->read(i, heads[i]));
    });
  });
}

}  // namespace lucarne
