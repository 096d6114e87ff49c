#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>

#include "base/exr_heads.h"
#include "base/exr_open.h"
#include "base/image_file.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;

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

}  // namespace lucarne
