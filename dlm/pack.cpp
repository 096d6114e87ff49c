#include "dlm/pack.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "dlm/pack_skyline.h"

namespace lucarne {
namespace {

int roundUpTo4(double x) { return static_cast<int>(std::ceil(x / 4)) * 4; }

struct Demand {
  std::vector<RectSize> padded;  // with gutters
  double area = 0;
  int width = 0, height = 0;  // of the largest
};

Demand addGutters(const std::vector<RectSize>& sizes, const PackOptions& options) {
  Demand demand;
  demand.padded.reserve(sizes.size());
  for (const RectSize& size : sizes) {
    LUCARNE_CHECK_LT(0, size.width);
    LUCARNE_CHECK_LT(0, size.height);
    if (std::max(size.width, size.height) > options.hardLimit - 2 * options.gutter) {
      throw Error(ExitCode::outOfResource, "a chart of " + std::to_string(size.width) + " by " +
                                               std::to_string(size.height) + " texels is larger than a page of " +
                                               std::to_string(options.hardLimit) + ": lower the density");
    }
    demand.padded.push_back({size.width + 2 * options.gutter, size.height + 2 * options.gutter});
    demand.area += static_cast<double>(demand.padded.back().width) * demand.padded.back().height;
    demand.width = std::max(demand.width, demand.padded.back().width);
    demand.height = std::max(demand.height, demand.padded.back().height);
  }
  return demand;
}

double areaOf(const Packing& packing) { return static_cast<double>(packing.pageWidth) * packing.pageHeight; }

Packing finish(const SkylinePacking& packed, int width, int height, int gutter) {
  Packing packing;
  packing.pageWidth = width;
  packing.pageHeight = height;
  packing.pageCount = packed.pageCount;
  packing.places = packed.places;
  for (Placement& place : packing.places) {
    place.x += gutter;
    place.y += gutter;
  }
  return packing;
}

/// One page about as wide as a square of the whole area would be, as tall as it then turns out: the width that gives
/// the smallest page. No pages where one does not hold all.
Packing packOnePage(const Demand& demand, const PackOptions& options, int limit) {
  const int largest = limit / 4 * 4;
  Packing best;
  for (const double factor : {1.0, 1.02, 1.05, 1.09, 1e9}) {
    if (factor > 2 && best.pageCount > 0) break;  // only where nothing narrower did
    const double wanted = std::min(std::sqrt(demand.area) * factor, static_cast<double>(largest));
    const int width = std::min(largest, std::max(roundUpTo4(demand.width), roundUpTo4(wanted)));
    const SkylinePacking packed = packSkyline(demand.padded, width, largest);
    if (packed.pageCount != 1) continue;
    const Packing page = finish(packed, width, roundUpTo4(packed.usedHeight), options.gutter);
    if (best.pageCount == 0 || areaOf(page) < areaOf(best)) best = page;
  }
  return best;
}

/// As few pages of the largest size as there must be, then all of them smaller while no more are needed.
Packing packPages(const Demand& demand, const PackOptions& options) {
  const int limit = options.maxPageSize / 4 * 4;
  int width = std::max(limit, roundUpTo4(demand.width)), height = std::max(limit, roundUpTo4(demand.height));
  SkylinePacking best = packSkyline(demand.padded, width, height);
  const double share = demand.area / best.pageCount;
  for (const double slack : {1.02, 1.05, 1.1, 1.18, 1.3, 1.5}) {
    const int side = roundUpTo4(std::sqrt(share * slack));
    const int w = std::max(side, roundUpTo4(demand.width)), h = std::max(side, roundUpTo4(demand.height));
    if (static_cast<double>(w) * h >= static_cast<double>(width) * height) break;
    SkylinePacking tried = packSkyline(demand.padded, w, h);
    if (tried.pageCount > best.pageCount) continue;
    best = std::move(tried);
    width = w;
    height = h;
    break;
  }
  return finish(best, width, height, options.gutter);
}

}  // namespace

Packing packRectangles(const std::vector<RectSize>& sizes, const PackOptions& options) {
  const Demand demand = addGutters(sizes, options);
  if (sizes.empty()) return {};
  const int limit = options.singlePage
                        ? options.hardLimit
                        : std::max({options.maxPageSize, roundUpTo4(demand.width), roundUpTo4(demand.height)});
  const double side = std::min(limit, options.hardLimit);
  if (demand.area <= side * side) {
    const Packing page = packOnePage(demand, options, static_cast<int>(side));
    if (page.pageCount == 1) return page;
  }
  if (options.singlePage) {
    throw Error(ExitCode::outOfResource, "the charts do not fit into one page of " + std::to_string(options.hardLimit) +
                                             " by " + std::to_string(options.hardLimit) + " texels: lower the density");
  }
  return packPages(demand, options);
}

}  // namespace lucarne
