#include "player/read_back.h"

#include <algorithm>

namespace lucarne {

ImageRgb readBack(const FrameTarget& target) {
  const auto width = static_cast<std::size_t>(target.width), height = static_cast<std::size_t>(target.height);
  ImageRgb image{target.width, target.height, std::vector<Rgb>(width * height)};
  static_assert(sizeof(Rgb) == 12);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.shading.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, target.width, target.height, GL_RGB, GL_FLOAT, image.pixels.data());
  for (std::size_t y = 0; y < height / 2; ++y) {  // OpenGL counts rows from the bottom
    const auto top = image.pixels.begin() + static_cast<std::ptrdiff_t>(y * width);
    const auto bottom = image.pixels.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * width);
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(width), bottom);
  }
  return image;
}

}  // namespace lucarne
