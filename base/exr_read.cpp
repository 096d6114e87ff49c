#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/exr_open.h"
#include "base/image_file.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;

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

}  // namespace

const ExrChannel* ExrLayer::find(const std::string& channel) const {
  for (const ExrChannel& candidate : channels) {
    if (candidate.name == channel) return &candidate;
  }
  return nullptr;
}

std::vector<ExrLayer> readExr(const std::filesystem::path& path) {
  std::vector<ExrLayer> layers;
  withExr(path, ExrTiles::refused, [&](imf::MultiPartInputFile& input, std::uint64_t) {
    for (int part = 0; part < input.parts(); ++part) layers.push_back(readLayer(input, part));
  });
  return layers;
}

}  // namespace lucarne
