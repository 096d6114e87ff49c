#include "base/exr_header_scan.h"

#include <bit>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/exr_stream.h"

namespace lucarne {
namespace {

static_assert(std::endian::native == std::endian::little, "OpenEXR files are little-endian");

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiled = 0x200, kDeep = 0x800, kMultiPart = 0x1000;
constexpr std::uint32_t kKnownFlags = kTiled | 0x400 | kDeep | kMultiPart;
constexpr std::size_t kLongestName = 255;
constexpr std::uint32_t kLongestTypeText = 64;
constexpr int kMaxParts = 4096;

/// Walks "name\0 type\0 size value" records, once for each part of the file.
class HeaderScan {
 public:
  HeaderScan(const InputFile& file, ExrTiles tiles)
      : name_(file.path().string()), size_(file.size()), tiles_(tiles), stream_(file) {}

  void scan() {
    if (readU32() != kMagic) refuse("is not an OpenEXR file");
    const std::uint32_t version = readU32();
    if ((version & 0xff) != 2 || (version & ~(kKnownFlags | 0xffu)) != 0) refuse("is of an unknown OpenEXR version");
    if ((version & kDeep) != 0) refuse("is a deep OpenEXR file, which is not read; flatten it");
    isTiled_ = (version & kTiled) != 0;
    isMultiPart_ = (version & kMultiPart) != 0;
    if (isTiled_) checkTiled();
    int parts = 0;
    while (scanPart()) {
      ++parts;
      if (!isMultiPart_) return;
      if (parts > kMaxParts) refuse("has more than " + std::to_string(kMaxParts) + " layers");
    }
    if (parts == 0) refuse("has an empty OpenEXR header");
  }

 private:
  /// False when there was no attribute at all: the end of the list of parts.
  bool scanPart() {
    bool any = false;
    for (std::string key = readText(); !key.empty(); key = readText()) {
      any = true;
      const std::string type = readText();
      const std::uint32_t length = readU32();
      if (length > size_ - stream_.tellg()) refuse("is damaged: the attribute \"" + key + "\" is longer than the file");
      if (key == "type" && type == "string" && length <= kLongestTypeText) {
        checkPartType(readBytes(length));
      } else {
        stream_.seekg(stream_.tellg() + length);
      }
    }
    return any;
  }

  /// A file of one part says twice whether it is tiled: in the version's flags, and perhaps in its type.
  void checkPartType(const std::string& type) {
    if (type.starts_with("deep")) refuse("has a deep layer, which is not read; flatten it");
    const bool isTiled = type == "tiledimage";
    if (isTiled) checkTiled();
    if (!isMultiPart_ && isTiled != isTiled_) refuse("is damaged: it says both that it is tiled and that it is not");
  }

  std::string readBytes(std::size_t count) {
    std::string bytes(count, '\0');
    stream_.read(bytes.data(), static_cast<int>(count));
    return bytes;
  }

  std::uint32_t readU32() {
    std::uint32_t value = 0;
    std::memcpy(&value, readBytes(sizeof value).data(), sizeof value);
    return value;
  }

  std::string readText() {
    std::string text;
    for (char c = readBytes(1)[0]; c != '\0'; c = readBytes(1)[0]) {
      if (text.size() == kLongestName) refuse("is damaged: a name in its header does not end");
      text += c;
    }
    return text;
  }

  void checkTiled() const {
    if (tiles_ == ExrTiles::refused) refuse("is a tiled OpenEXR file, which is not read here; save it as scanlines");
  }
  [[noreturn]] void refuse(const std::string& reason) const { throw InputError(name_ + " " + reason); }

  std::string name_;
  std::uint64_t size_;
  ExrTiles tiles_;
  bool isTiled_ = false, isMultiPart_ = false;
  ExrInputStream stream_;
};

}  // namespace

void scanExrHeader(const InputFile& file, ExrTiles tiles) { HeaderScan(file, tiles).scan(); }

}  // namespace lucarne
