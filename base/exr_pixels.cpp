#include "base/exr_pixels.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/exr_heads.h"
#include "base/exr_open.h"
#include "base/exr_stream.h"
#include "base/huge_buffer.h"

namespace lucarne {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;

imf::PixelType exrType(ChannelType type) {
  return type == ChannelType::uint32 ? imf::UINT : type == ChannelType::half ? imf::HALF : imf::FLOAT;
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

  std::span<const std::byte> read(std::size_t index, const ExrLayer& head, const ExrWish& wish) {
    const int part = static_cast<int>(index);
    // The file was checked when another look at it began.
    if (part >= input_.parts() || !sameShape(headOf(input_.header(part)), head))
      throw InputError(name_ + ": was altered while it was read");
    const std::size_t rowBytes = wish.pixelBytes() * static_cast<std::size_t>(head.width);
    const std::size_t bytes = rowBytes * static_cast<std::size_t>(wish.endRow - wish.firstRow);
    // The memory of the layer before serves again: fresh memory costs more time than what is read into it.
    if (pixels_.size() < bytes) pixels_ = HugeBuffer<std::byte>(bytes);
    readRows(part, wish, rowBytes);
    return pixels_.span().first(bytes);
  }

 private:
  void readRows(int index, const ExrWish& wish, std::size_t rowBytes) {
    imath::Box2i window = input_.header(index).dataWindow();
    window.max.y = window.min.y + wish.endRow - 1;
    window.min.y += wish.firstRow;
    imf::FrameBuffer frame;
    std::byte* slot = pixels_.data();
    for (const ExrWish::Slot& s : wish.slots) {
      frame.insert(s.channel, imf::Slice::Make(exrType(s.type), slot, window, wish.pixelBytes(), rowBytes));
      slot += bytesOf(s.type);
    }
    imf::InputPart part(input_, index);
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
  }

  std::string name_;
  ExrInputStream stream_;
  imf::MultiPartInputFile input_;
  HugeBuffer<std::byte> pixels_;
};

void checkWish(const ExrLayer& head, const ExrWish& wish) {
  LUCARNE_CHECK_LE(0, wish.firstRow);
  LUCARNE_CHECK_LE(wish.endRow, head.height);
  for (const ExrWish::Slot& s : wish.slots) {
    const ExrChannel* channel = head.find(s.channel);
    if (channel != nullptr) LUCARNE_CHECK_EQ(channel->type == ChannelType::uint32, s.type == ChannelType::uint32);
  }
}

}  // namespace

std::size_t ExrWish::pixelBytes() const {
  std::size_t bytes = 0;
  for (const Slot& s : slots) bytes += bytesOf(s.type);
  return bytes;
}

void readExrPixels(const std::filesystem::path& path, const ExrPixelUse& use) {
  withExr(path, ExrTiles::refused, [&](imf::MultiPartInputFile& input, const InputFile& file) {
    const std::vector<ExrLayer> heads = headsOf(input);
    const std::vector<ExrWish> wishes = use.choose(heads);
    LUCARNE_CHECK_EQ(wishes.size(), heads.size());
    for (std::size_t i = 0; i < heads.size(); ++i) checkWish(heads[i], wishes[i]);
    tbb::enumerable_thread_specific<std::unique_ptr<Reader>> readers;
    tbb::parallel_for(std::size_t{0}, heads.size(), [&](std::size_t i) {
      if (!wishes[i].any()) return;
      std::unique_ptr<Reader>& reader = readers.local();
      if (!reader) reader = std::make_unique<Reader>(file);
      use.take(i, reader->read(i, heads[i], wishes[i]));
    });
  });
}

}  // namespace lucarne
