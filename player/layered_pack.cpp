#include "player/layered_pack.h"

#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

#include "base/error.h"

namespace lucarne {
namespace {

constexpr std::size_t kOpenPages = 64;  // so many of the last ones are tried: all, but in huge scenes

/// One page being filled from the top left, as deep as the first rectangle that it was made for.
class Page {
 public:
  Page(int width, int height, int firstLayer) : nodes_(static_cast<std::size_t>(width)), firstLayer_(firstLayer) {
    stbrp_init_target(&context_, width, height, nodes_.data(), width);
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  std::optional<LayeredPlace> add(const LayeredRect& rect) {
    stbrp_rect r{};
    r.w = rect.width;
    r.h = rect.height;
    stbrp_pack_rects(&context_, &r, 1);
    if (r.was_packed == 0) return std::nullopt;
    return LayeredPlace{static_cast<int>(r.x), static_cast<int>(r.y), firstLayer_};
  }

 private:
  stbrp_context context_{};
  std::vector<stbrp_node> nodes_;
  int firstLayer_;
};

/// Deepest first, so that each page is as deep as its first rectangle; then tallest, as skyline packing likes it.
std::vector<std::size_t> packingOrder(const std::vector<LayeredRect>& rects) {
  std::vector<std::size_t> order(rects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    const LayeredRect &a = rects[i], &b = rects[k];
    if (a.layers != b.layers) return a.layers > b.layers;
    return a.height != b.height ? a.height > b.height : a.width > b.width;
  });
  return order;
}

std::optional<LayeredPacking> packInto(const std::vector<LayeredRect>& rects, const std::vector<std::size_t>& order,
                                       int width, int height, int maxLayers) {
  LayeredPacking packing{width, height, 0, std::vector<LayeredPlace>(rects.size())};
  std::deque<Page> pages;  // the shallowest last; all are as deep as what is still to come
  for (const std::size_t i : order) {
    std::optional<LayeredPlace> place;
    for (auto page = pages.rbegin(); page != pages.rend() && !place; ++page) place = page->add(rects[i]);
    if (!place) {
      pages.emplace_back(width, height, packing.layers);
      if (pages.size() > kOpenPages) pages.pop_front();
      packing.layers += rects[i].layers;
      if (packing.layers > maxLayers) return std::nullopt;
      place = pages.back().add(rects[i]);
      if (!place) return std::nullopt;
    }
    packing.places[i] = *place;
  }
  packing.layers = std::max(packing.layers, 1);
  return packing;
}

int powerOfTwoFrom(int value) {
  int power = 1;
  while (power < value) power *= 2;
  return power;
}

std::optional<LayeredPacking> smallestPacking(const std::vector<LayeredRect>& rects, const LayeredRect& largest,
                                              const TextureLimits& limits) {
  const std::vector<std::size_t> order = packingOrder(rects);
  const int minWidth = powerOfTwoFrom(largest.width), minHeight = powerOfTwoFrom(largest.height);
  std::optional<LayeredPacking> best;
  for (int size = std::max(minWidth, minHeight); size <= limits.size; size *= 2) {
    for (int height = std::max(size / 8, minHeight); height <= size; height *= 2) {
      std::optional<LayeredPacking> candidate = packInto(rects, order, size, height, limits.layers);
      if (candidate && (!best || candidate->texels() < best->texels())) best = std::move(candidate);
    }
    if (best && (size >= 4096 || best->layers == largest.layers)) break;  // a larger page cannot be better
  }
  return best;
}

}  // namespace

LayeredPacking packLayered(const std::vector<LayeredRect>& rects, const TextureLimits& limits) {
  LayeredRect largest;
  for (const LayeredRect& r : rects) {
    largest = {std::max(largest.width, r.width), std::max(largest.height, r.height),
               std::max(largest.layers, r.layers)};
  }
  std::optional<LayeredPacking> best;
  if (largest.width <= limits.size && largest.height <= limits.size && largest.layers <= limits.layers) {
    best = smallestPacking(rects, largest, limits);
  }
  if (!best) {
    throw Error(ExitCode::outOfResource,
                "the light maps do not fit into one OpenGL texture array; bake with a lower --density");
  }
  return *std::move(best);
}

}  // namespace lucarne
