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

std::vector<std::uint8_t> readBackBytes(GLuint framebuffer, int width, int height) {
  const auto row = static_cast<std::size_t>(width) * 3;
  std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(height)), flipped;
  flipped.reserve(pixels.size());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  if (framebuffer == 0) glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  for (std::size_t y = static_cast<std::size_t>(height); y-- > 0;) {
    const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(y * row);
    flipped.insert(flipped.end(), from, from + static_cast<std::ptrdiff_t>(row));
  }
  return flipped;
}

}  // namespace lucarne
