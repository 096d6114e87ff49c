#include "base/image_size.h"

#include <algorithm>

#include "base/error.h"
#include "base/image_file.h"

namespace lucarne {

void checkImageSize(const std::string& name, std::int64_t width, std::int64_t height, std::uint64_t bytesPerPixel,
                    std::uint64_t fileBytes) {
  constexpr std::uint64_t kAlwaysAllowed = std::uint64_t{64} << 20;
  constexpr std::uint64_t kLargestRatio = 4000;
  constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 50;  // keeps the product below in 64 bits
  constexpr std::int64_t kLargestSide = std::int64_t{1} << 31;
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width < 1 || height < 1) throw InputError(name + ": an image of " + size + " is not usable");
  const bool sidesFit = width < kLargestSide && height < kLargestSide;
  const std::uint64_t pixels = sidesFit ? static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) : 0;
  if (!sidesFit || pixels > kMaxPixels) {
    throw InputError(name + ": an image of " + size + " is too large (at most " + std::to_string(kMaxPixels) +
                     " pixels); scale it down");
  }
  const std::uint64_t believable = kAlwaysAllowed + kLargestRatio * std::min(fileBytes, kLargestFile);
  if (bytesPerPixel > believable / pixels) {
    throw InputError(name + ": the file claims " + size + " but has only " + std::to_string(fileBytes) +
                     " bytes: it is damaged or cut short");
  }
}

}  // namespace lucarne
