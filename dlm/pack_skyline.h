// Rectangles into pages of one fixed size: stb_rect_pack, with rows of equal height packed beforehand.
#pragma once

#include <vector>

#include "dlm/pack.h"

namespace lucarne {

struct SkylinePacking {
  int pageCount = 0;
  int usedHeight = 0;  // of the fullest page
  std::vector<Placement> places;
};

/// Deterministic. Every size must fit into a page. Where there are very many rectangles, runs of equal height are first
/// laid side by side into rows as wide as the page: the skyline search is linear in its steps, and thousands of small
/// rectangles would give it thousands.
SkylinePacking packSkyline(const std::vector<RectSize>& sizes, int pageWidth, int pageHeight);

}  // namespace lucarne
