#include "dlm/manifest_cover.h"

namespace lucarne {

PageCover::PageCover(int width, int height, std::int64_t layers)
    : width_(width), height_(height), layers_(layers), taken_(static_cast<std::size_t>(width_ * height_ * layers_)) {}

bool PageCover::add(std::int64_t x, std::int64_t y, std::int64_t layer, std::int64_t width, std::int64_t height) {
  if (x < 0 || y < 0 || layer < 0 || layer >= layers_ || width <= 0 || height <= 0) return false;
  if (x > width_ - width || y > height_ - height) return false;
  for (std::int64_t row = 0; row < height; ++row) {
    const auto first = static_cast<std::size_t>(x + width_ * (y + row + height_ * layer));
    for (std::size_t i = first; i < first + static_cast<std::size_t>(width); ++i) {
      if (taken_[i]) return false;
      taken_[i] = true;
    }
  }
  return true;
}

bool PageCover::addAt(std::int64_t place, std::int64_t width, std::int64_t height) {
  if (place < 0 || width_ == 0 || height_ == 0) return false;
  return add(place % width_, place / width_ % height_, place / (width_ * height_), width, height);
}

}  // namespace lucarne
