#include "dlm/pack_skyline.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <stb/stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace lucarne {
namespace {

constexpr std::size_t kRowsFrom = 2000;  // rectangles; fewer are packed one by one

/// What stb places: one rectangle, or a row of several of equal height.
struct Block {
  int width, height;
  std::vector<std::uint32_t> members;  // left to right
};

std::vector<std::uint32_t> byHeightThenWidth(const std::vector<RectSize>& sizes) {
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&sizes](std::uint32_t a, std::uint32_t b) {
    if (sizes[a].height != sizes[b].height) return sizes[a].height > sizes[b].height;
    return sizes[a].width > sizes[b].width;
  });
  return order;
}

/// Cuts the sorted rectangles into rows. A row is closed when the next does not fit; rectangles of a height that cannot
/// fill a row stay alone.
std::vector<Block> makeBlocks(const std::vector<RectSize>& sizes, int pageWidth) {
  std::vector<Block> blocks;
  const std::vector<std::uint32_t> order = byHeightThenWidth(sizes);
  const bool rows = sizes.size() >= kRowsFrom;
  Block row{0, 0, {}};
  const auto dissolve = [&] {
    for (const std::uint32_t i : row.members) blocks.push_back({sizes[i].width, sizes[i].height, {i}});
    row = {0, 0, {}};
  };
  for (const std::uint32_t i : order) {
    const RectSize size = sizes[i];
    if (!rows || size.height != row.height) dissolve();
    row.height = size.height;
    if (row.width + size.width > pageWidth) {
      blocks.push_back(std::move(row));
      row = {0, size.height, {}};
    }
    row.width += size.width;
    row.members.push_back(i);
  }
  dissolve();
  return blocks;
}

/// Packs what fits of `left` (indices into blocks) into one more page and removes it from the list.
void packPage(const std::vector<Block>& blocks, const std::vector<RectSize>& sizes, int pageWidth, int pageHeight,
              std::vector<std::size_t>& left, SkylinePacking& packing) {
  std::vector<stbrp_rect> rects(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    rects[i] = {static_cast<int>(i), blocks[left[i]].width, blocks[left[i]].height, 0, 0, 0};
  }
  std::vector<stbrp_node> nodes(static_cast<std::size_t>(pageWidth));
  stbrp_context context;
  stbrp_init_target(&context, pageWidth, pageHeight, nodes.data(), pageWidth);
  stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()));
  std::vector<std::size_t> unpacked;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    if (!rects[i].was_packed) {
      unpacked.push_back(left[i]);
      continue;
    }
    const Block& block = blocks[left[i]];
    int x = rects[i].x;
    for (const std::uint32_t member : block.members) {
      packing.places[member] = {packing.pageCount, x, rects[i].y};
      x += sizes[member].width;
    }
    packing.usedHeight = std::max(packing.usedHeight, rects[i].y + block.height);
  }
  ++packing.pageCount;
  LUCARNE_CHECK_LT(unpacked.size(), left.size());
  left = std::move(unpacked);
}

}  // namespace

SkylinePacking packSkyline(const std::vector<RectSize>& sizes, int pageWidth, int pageHeight) {
  SkylinePacking packing;
  packing.places.resize(sizes.size());
  const std::vector<Block> blocks = makeBlocks(sizes, pageWidth);
  std::vector<std::size_t> left(blocks.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  while (!left.empty()) packPage(blocks, sizes, pageWidth, pageHeight, left, packing);
  return packing;
}

}  // namespace lucarne
