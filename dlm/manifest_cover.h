// Which texels of a stack of pages are taken: rectangles must lie inside and apart.
#pragma once

#include <cstdint>
#include <vector>

namespace lucarne {

class PageCover {
 public:
  /// Sizes >= 0; a bit a texel.
  PageCover(int width, int height, std::int64_t layers);

  /// Takes a rectangle; false when it is empty, leaves its page or meets one taken before.
  bool add(std::int64_t x, std::int64_t y, std::int64_t layer, std::int64_t width, std::int64_t height);
  /// The same for a rectangle whose first texel is at x + width · (y + height · layer), of the pages.
  bool addAt(std::int64_t place, std::int64_t width, std::int64_t height);

 private:
  std::int64_t width_, height_, layers_;
  std::vector<bool> taken_;
};

}  // namespace lucarne
