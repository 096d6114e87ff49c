// Packing of rectangles into equal pages, with a gutter around each (stb_rect_pack).
#pragma once

#include <cstdint>
#include <vector>

namespace lucarne {

struct RectSize {
  int width, height;  // without gutter, > 0
};

struct Placement {
  int page, x, y;  // of the rectangle's own first texel; the gutter lies around it
};

struct Packing {
  int pageWidth = 0, pageHeight = 0, pageCount = 0;
  std::vector<Placement> places;  // in the order of the sizes
};

struct PackOptions {
  int gutter = 1;           // texels on each side
  int maxPageSize = 4096;   // pages are no larger, unless one rectangle needs it
  bool singlePage = false;  // grow one page beyond maxPageSize (up to hardLimit) instead of opening another
  int hardLimit = 16384;    // throws Error(outOfResource) beyond it
};

/// Deterministic. Page sides are multiples of 4, chosen so that little is wasted.
Packing packRectangles(const std::vector<RectSize>& sizes, const PackOptions& options);

}  // namespace lucarne
