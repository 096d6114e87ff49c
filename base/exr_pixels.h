// Rows of the layers of an OpenEXR file, as pixels with their channels side by side, several layers at once: for files whose
// layers would fill the memory together, and for those who take pixels as they are.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/image_file.h"

namespace lucarne {

constexpr std::size_t bytesOf(ChannelType type) { return type == ChannelType::half ? 2 : 4; }

/// What is wanted of a layer.
struct ExrWish {
  struct Slot {
    std::string channel;  // one that the layer lacks gives zeros
    ChannelType type;     // in memory: half and float32 are made of each other, uint32 is only itself
  };
  std::vector<Slot> slots;        // of a pixel, one after the other
  int firstRow = 0, endRow = 0;   // none: the layer is not read
  bool any() const { return firstRow < endRow; }
  std::size_t pixelBytes() const;
};

struct ExrPixelUse {
  /// Told all layers, their channels without values, before any is read: a wish for each.
  std::function<std::vector<ExrWish>(const std::vector<ExrLayer>& heads)> choose;
  /// The wanted rows of a layer, top first, which are gone afterwards; from several threads at once, in no order. `index`
  /// counts all layers of the file.
  std::function<void(std::size_t index, std::span<const std::byte> pixels)> take;
};

/// Holds no more than a layer's rows a thread. What `use` throws ends the reading and is thrown on; InputError names the file.
void readExrPixels(const std::filesystem::path& path, const ExrPixelUse& use);

}  // namespace lucarne
