// Rectangles with a depth, packed into the layers of one texture array.
//
// Each rectangle takes `layers` consecutive layers at one place. Rectangles of like depth share a page (a run of
// layers), so that little of a page's depth stays empty. Pages are powers of two wide and high: a texel centre times
// the size is then exact in float, and a lookup clamped to texel centres never reads a neighbour; no gutter is needed.
#pragma once

#include <cstdint>
#include <vector>

namespace lucarne {

struct LayeredRect {
  int width = 1, height = 1, layers = 1;  // all > 0
};

struct LayeredPlace {
  int x = 0, y = 0, layer = 0;
};

struct LayeredPacking {
  int width = 1, height = 1, layers = 1;  // of the array
  std::vector<LayeredPlace> places;       // in the order of the rectangles
  std::uint64_t texels() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * static_cast<std::uint64_t>(layers);
  }
};

struct TextureLimits {
  int size = 16384;   // largest width and height
  int layers = 2048;  // of an array
};

/// The smallest array found. Throws Error(outOfResource) when none within the limits holds everything.
LayeredPacking packLayered(const std::vector<LayeredRect>& rects, const TextureLimits& limits);

}  // namespace lucarne
