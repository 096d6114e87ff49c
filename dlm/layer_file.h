// The layers of one image file of a .dlm, asked for by name.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/image_file.h"

namespace lucarne {

/// What is wrong with the file is an InputError that names it.
class LayerFile {
 public:
  LayerFile(const std::filesystem::path& path, std::vector<ExrLayer> layers)
      : name_(path.string()), layers_(std::move(layers)) {}

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  const ExrLayer& layer(const std::string& name, int width, int height) const {
    const auto found = std::find_if(layers_.begin(), layers_.end(), [&](const ExrLayer& l) { return l.name == name; });
    if (found == layers_.end()) fail("has no layer \"" + name + "\", which the manifest names");
    if (found->width != width || found->height != height) {
      fail("the layer \"" + name + "\" is " + sizeText(found->width, found->height) + ", not " +
           sizeText(width, height) + " as the manifest says");
    }
    return *found;
  }
  std::size_t indexOf(const ExrLayer& layer) const { return static_cast<std::size_t>(&layer - layers_.data()); }
  const ExrLayer& at(std::size_t index) const { return layers_[index]; }

  /// That it has such a channel.
  const ExrChannel& realChannel(const ExrLayer& layer, const std::string& channel) const {
    const ExrChannel* found = layer.find(channel);
    if (found == nullptr || found->type == ChannelType::uint32)
      fail("the layer \"" + layer.name + "\" has no channel " + channel + " of real numbers");
    return *found;
  }
  const ExrChannel& wholeChannel(const ExrLayer& layer, const std::string& channel) const {
    const ExrChannel* found = layer.find(channel);
    if (found == nullptr || found->type != ChannelType::uint32)
      fail("the layer \"" + layer.name + "\" has no channel " + channel + " of whole numbers");
    return *found;
  }

  /// Finite.
  const std::vector<float>& values(const ExrLayer& layer, const std::string& channel) const {
    const std::vector<float>& floats = realChannel(layer, channel).floats;
    if (!std::all_of(floats.begin(), floats.end(), [](float v) { return std::isfinite(v); }))
      fail("the channel " + channel + " of the layer \"" + layer.name + "\" holds a number that is not finite");
    return floats;
  }
  std::array<const std::vector<float>*, 3> rgb(const ExrLayer& layer) const {
    return {&values(layer, "R"), &values(layer, "G"), &values(layer, "B")};
  }

 private:
  static std::string sizeText(int width, int height) { return std::to_string(width) + " × " + std::to_string(height); }

  std::string name_;
  std::vector<ExrLayer> layers_;
};

}  // namespace lucarne
