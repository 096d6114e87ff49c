#include "dlm/contact_bins.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

constexpr double kNear = 2e-3;  // texels: what is so near a texel is in it, too

struct TexelRange {
  int x0, y0, x1, y1;  // inclusive
};

TexelRange texelsAbout(Vec2d lo, Vec2d hi, int width, int height) {
  const auto at = [](double v, int size) { return static_cast<int>(std::floor(std::clamp(v, 0.0, size - 0.5))); };
  return {at(lo.x - kNear, width), at(lo.y - kNear, height), at(hi.x + kNear, width), at(hi.y + kNear, height)};
}

/// Some of the line is in the square of a texel, or near it.
bool meets(const ContactLine& line, int x, int y) {
  double first = 0, last = 1;
  const Vec2d d = line.b - line.a;
  for (const auto& [from, along, low] : {std::array{line.a.x, d.x, double(x)}, std::array{line.a.y, d.y, double(y)}}) {
    const double lo = low - kNear - from, hi = low + 1 + kNear - from;
    if (along == 0) {
      if (lo > 0 || hi < 0) return false;
      continue;
    }
    first = std::max(first, std::min(lo / along, hi / along));
    last = std::min(last, std::max(lo / along, hi / along));
  }
  return first <= last;
}

bool crosses(const ContactLine& line, Vec2d p, Vec2d q) {
  const double a = cross2(q - p, line.a - p), b = cross2(q - p, line.b - p);
  if ((a > 0 && b > 0) || (a < 0 && b < 0)) return false;
  const Vec2d d = line.b - line.a;
  const double from = cross2(d, p - line.a), to = cross2(d, q - line.a);
  return !((from > 0 && to > 0) || (from < 0 && to < 0));
}

}  // namespace

ContactBins::ContactBins(int width, int height, const SideLines& lines) : width_(width), height_(height), all_(lines) {
  lines_ = enterLines();
  covers_ = enterCovers();
  for (const auto* entries : {&lines_, &covers_})
    for (const Entry& e : *entries) texels_.push_back(e.texel);
  std::sort(texels_.begin(), texels_.end());
  texels_.erase(std::unique(texels_.begin(), texels_.end()), texels_.end());
  index_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kNone);
  for (std::uint32_t i = 0; i < texels_.size(); ++i) index_[texels_[i]] = i;
  const auto firsts = [this](const std::vector<Entry>& entries) {
    std::vector<std::size_t> first(texels_.size() + 1, 0);
    for (const Entry& e : entries) ++first[index_[e.texel] + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    return first;
  };
  firstLine_ = firsts(lines_);
  firstCover_ = firsts(covers_);
}

std::vector<ContactBins::Entry> ContactBins::enterLines() const {
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < all_.lines.size(); ++i) {
    const ContactLine& line = all_.lines[i];
    const TexelRange range = texelsAbout({std::min(line.a.x, line.b.x), std::min(line.a.y, line.b.y)},
                                         {std::max(line.a.x, line.b.x), std::max(line.a.y, line.b.y)}, width_, height_);
    for (int y = range.y0; y <= range.y1; ++y)
      for (int x = range.x0; x <= range.x1; ++x)
        if (meets(line, x, y)) entries.push_back({static_cast<std::uint32_t>(y * width_ + x), i});
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<ContactBins::Entry> ContactBins::enterCovers() const {
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < all_.covers.size(); ++i) {
    const PlanePolygon& cover = all_.covers[i];
    Vec2d lo = cover.corner[0], hi = lo;
    for (std::size_t k = 1; k < cover.count; ++k) {
      lo = {std::min(lo.x, cover.corner[k].x), std::min(lo.y, cover.corner[k].y)};
      hi = {std::max(hi.x, cover.corner[k].x), std::max(hi.y, cover.corner[k].y)};
    }
    const TexelRange range = texelsAbout(lo, hi, width_, height_);
    for (int y = range.y0; y <= range.y1; ++y)
      for (int x = range.x0; x <= range.x1; ++x) entries.push_back({static_cast<std::uint32_t>(y * width_ + x), i});
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

bool ContactBins::crossedIn(std::uint32_t touched, Vec2d p, Vec2d q) const {
  const auto lines = linesOf(touched);
  return std::any_of(lines.begin(), lines.end(), [&](const Entry& e) { return crosses(all_.lines[e.item], p, q); });
}

bool ContactBins::crossed(Vec2d p, Vec2d q) const {
  const TexelRange range =
      texelsAbout({std::min(p.x, q.x), std::min(p.y, q.y)}, {std::max(p.x, q.x), std::max(p.y, q.y)}, width_, height_);
  for (int y = range.y0; y <= range.y1; ++y) {
    for (int x = range.x0; x <= range.x1; ++x) {
      const std::uint32_t touched =
          index_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      if (touched != kNone && crossedIn(touched, p, q)) return true;
    }
  }
  return false;
}

bool ContactBins::covered(std::uint32_t touched, Vec2d p) const {
  return std::any_of(covers_.begin() + static_cast<std::ptrdiff_t>(firstCover_[touched]),
                     covers_.begin() + static_cast<std::ptrdiff_t>(firstCover_[touched + 1]),
                     [&](const Entry& e) { return all_.covers[e.item].holds(p); });
}

}  // namespace lucarne
