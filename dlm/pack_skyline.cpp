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
void makeBlocks(const std::vector<RectSize>& sizes, int pageWidth, std::vector<Block>& rows,
                std::vector<Block>& singles) {
  const bool useRows = sizes.size() >= kRowsFrom;
  Block row{0, 0, {}};
  const auto dissolve = [&] {
    for (const std::uint32_t i : row.members) singles.push_back({sizes[i].width, sizes[i].height, {i}});
    row = {0, 0, {}};
  };
  for (const std::uint32_t i : byHeightThenWidth(sizes)) {
    const RectSize size = sizes[i];
    if (!useRows || size.height != row.height) dissolve();
    if (row.width + size.width > pageWidth) {
      rows.push_back(std::move(row));
      row = {0, 0, {}};
    }
    row.height = size.height;
    row.width += size.width;
    row.members.push_back(i);
  }
  dissolve();
}

/// One page being filled; what did not fit stays in the list that was given.
class Page {
 public:
  Page(const std::vector<RectSize>& sizes, int width, int height, SkylinePacking& packing)
      : sizes_(sizes), packing_(packing), number_(packing.pageCount++), nodes_(static_cast<std::size_t>(width)) {
    stbrp_init_target(&context_, width, height, nodes_.data(), width);
  }

  void take(std::vector<Block>& blocks) {
    std::vector<stbrp_rect> rects(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      rects[i] = {static_cast<int>(i), blocks[i].width, blocks[i].height, 0, 0, 0};
    }
    stbrp_pack_rects(&context_, rects.data(), static_cast<int>(rects.size()));
    std::vector<Block> left;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (rects[i].was_packed)
        place(blocks[i], rects[i]);
      else
        left.push_back(std::move(blocks[i]));
    }
    blocks = std::move(left);
  }

 private:
  void place(const Block& block, const stbrp_rect& rect) {
    int x = rect.x;
    for (const std::uint32_t member : block.members) {
      packing_.places[member] = {number_, x, rect.y};
      x += sizes_[member].width;
    }
    packing_.usedHeight = std::max(packing_.usedHeight, rect.y + block.height);
  }

  const std::vector<RectSize>& sizes_;
  SkylinePacking& packing_;
  int number_;
  std::vector<stbrp_node> nodes_;
  stbrp_context context_;
};

}  // namespace

SkylinePacking packSkyline(const std::vector<RectSize>& sizes, int pageWidth, int pageHeight) {
  SkylinePacking packing;
  packing.places.resize(sizes.size());
  std::vector<Block> rows, singles;
  makeBlocks(sizes, pageWidth, rows, singles);
  while (!rows.empty() || !singles.empty()) {
    const std::size_t before = rows.size() + singles.size();
    Page page(sizes, pageWidth, pageHeight, packing);
    // Rows first: on top of anything uneven, a row as wide as the page would leave gaps below it that nothing can
    // reach.
    page.take(rows);
    page.take(singles);
    LUCARNE_CHECK_LT(rows.size() + singles.size(), before);
  }
  return packing;
}

}  // namespace lucarne
