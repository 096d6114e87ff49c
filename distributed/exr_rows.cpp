#include "distributed/exr_rows.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/error.h"

namespace lucarne {
namespace {

static_assert(std::endian::native == std::endian::little, "OpenEXR files are little-endian");

constexpr std::uint32_t kMagic = 20000630, kVersion = 2 | 0x1000;  // 0x1000: multi-part
constexpr std::uint32_t kUint = 0;                                 // pixel type
constexpr char kNoCompression = 0, kIncreasingY = 0;

template <class T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

void putText(std::string& out, const std::string& text) { out.append(text.c_str(), text.size() + 1); }

void putAttribute(std::string& out, const std::string& name, const std::string& type, const std::string& value) {
  putText(out, name);
  putText(out, type);
  put(out, static_cast<std::uint32_t>(value.size()));
  out += value;
}

template <class... T>
std::string packed(T... values) {
  std::string bytes;
  (put(bytes, values), ...);
  return bytes;
}

std::string channelList(const std::vector<std::string>& channels) {
  std::string list;
  for (const std::string& name : channels) {
    putText(list, name);
    list += packed(kUint, std::uint32_t{0}, std::uint32_t{1}, std::uint32_t{1});  // type, not linear, no subsampling
  }
  return list + '\0';
}

}  // namespace

ExrRows::ExrRows(int width, std::vector<ExrRowsLayer> layers, const std::string& attribute, const std::string& text)
    : width_(width), layers_(std::move(layers)) {
  int displayHeight = 1;
  for (const ExrRowsLayer& layer : layers_) {
    LUCARNE_CHECK_EQ(std::is_sorted(layer.channels.begin(), layer.channels.end()), true);
    displayHeight = std::max(displayHeight, layer.height);
  }
  put(head_, kMagic);
  put(head_, kVersion);
  // First of all, so that a reader finds it without knowing the rest.
  putAttribute(head_, attribute, "string", text);
  for (const ExrRowsLayer& layer : layers_) head_ += header(layer, displayHeight) + '\0';
  head_ += '\0';
  fileBytes_ = head_.size();
  for (const ExrRowsLayer& layer : layers_) fileBytes_ += 8 * static_cast<std::uint64_t>(layer.height);
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    for (int y = 0; y < layers_[i].height; ++y) {
      put(head_, fileBytes_);
      fileBytes_ += kRowHeadBytes + rowBytes(i);
    }
  }
}

std::string ExrRows::header(const ExrRowsLayer& layer, int displayHeight) const {
  const auto window = [this](int height) { return packed(0, 0, width_ - 1, height - 1); };
  std::string out;
  putAttribute(out, "channels", "chlist", channelList(layer.channels));
  putAttribute(out, "chunkCount", "int", packed(layer.height));
  putAttribute(out, "compression", "compression", {kNoCompression});
  putAttribute(out, "dataWindow", "box2i", window(layer.height));
  putAttribute(out, "displayWindow", "box2i", window(displayHeight));
  putAttribute(out, "lineOrder", "lineOrder", {kIncreasingY});
  putAttribute(out, "name", "string", layer.name);
  putAttribute(out, "pixelAspectRatio", "float", packed(1.f));
  putAttribute(out, "screenWindowCenter", "v2f", packed(0.f, 0.f));
  putAttribute(out, "screenWindowWidth", "float", packed(1.f));
  putAttribute(out, "type", "string", "scanlineimage");
  return out;
}

std::uint64_t ExrRows::rowBytes(std::size_t layer) const {
  return 4 * static_cast<std::uint64_t>(width_) * layers_[layer].channels.size();
}

std::string ExrRows::rowHead(std::size_t layer, int y) const {
  return packed(static_cast<int>(layer), y, static_cast<int>(rowBytes(layer)));
}

std::string exrTextAttribute(const std::string& bytes, const std::string& name, std::uint64_t& needed) {
  const std::string start = packed(kMagic, kVersion) + name + '\0' + "string" + '\0';
  needed = 0;
  if (bytes.compare(0, start.size(), start, 0, std::min(start.size(), bytes.size())) != 0) return {};
  const std::size_t lengthAt = start.size(), textAt = lengthAt + 4;
  if (bytes.size() < textAt) {
    needed = textAt;
    return {};
  }
  const std::uint64_t length = wordAt(bytes, lengthAt);
  if (bytes.size() - textAt >= length) return bytes.substr(textAt, length);
  needed = textAt + length;
  return {};
}

}  // namespace lucarne
