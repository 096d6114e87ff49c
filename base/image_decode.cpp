#include <stb/stb_image.h>

#include <climits>
#include <memory>

#include "base/error.h"
#include "base/image_file.h"
#include "base/image_size.h"

namespace lucarne {
namespace {

template <std::size_t n>
bool startsWith(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, n>& signature) {
  return bytes.size() >= n && std::equal(signature.begin(), signature.end(), bytes.begin());
}

}  // namespace

DecodedImage decodeImage(std::span<const std::uint8_t> bytes, const std::string& name) {
  constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::array<std::uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};
  // The decoder would take other kinds too, through readers that have had more holes.
  if (!startsWith(bytes, kPng) && !startsWith(bytes, kJpeg)) {
    throw InputError(name + ": the image is neither PNG nor JPEG; convert it");
  }
  if (bytes.size() > INT_MAX) throw InputError(name + ": the image file is larger than 2 GiB");
  const int size = static_cast<int>(bytes.size());
  int channels = 0;
  DecodedImage image;
  if (stbi_info_from_memory(bytes.data(), size, &image.width, &image.height, &channels) == 0) {
    throw InputError(name + ": the image is damaged: " + stbi_failure_reason());
  }
  checkImageSize(name, image.width, image.height, 4, bytes.size());
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 4), stbi_image_free);
  if (rgba == nullptr) throw InputError(name + ": the image is damaged: " + stbi_failure_reason());
  const std::size_t length =
      std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgba.assign(rgba.get(), rgba.get() + length);
  return image;
}

}  // namespace lucarne
