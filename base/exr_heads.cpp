#include "base/exr_heads.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/exr_open.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;

ChannelType typeOf(imf::PixelType type) {
  return type == imf::UINT ? ChannelType::uint32 : type == imf::HALF ? ChannelType::half : ChannelType::float32;
}

}  // namespace

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

}  // namespace lucarne
