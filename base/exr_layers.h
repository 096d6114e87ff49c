// The layers of an OpenEXR file one by one, several at once: for files whose layers would fill the memory together.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "base/image_file.h"

namespace lucarne {

struct ExrLayerUse {
  /// Told all layers, their channels still without values, before any is read. True for each that is wanted.
  std::function<std::vector<bool>(const std::vector<ExrLayer>& heads)> choose;
  /// A wanted layer with its values, which are gone afterwards; from several threads at once, in no order. `index` counts
  /// all layers of the file.
  std::function<void(std::size_t index, const ExrLayer& layer)> take;
};

/// Like readExr(), without holding more than a layer a thread. What `use` throws ends the reading and is thrown on.
void readExrLayers(const std::filesystem::path& path, const ExrLayerUse& use);

}  // namespace lucarne
