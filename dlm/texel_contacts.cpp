#include "dlm/texel_contacts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "dlm/contact_regions.h"

namespace lucarne {

SideContacts::SideContacts(int width, int height, int radius) : width_(width), radius_(radius) {
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  share_.assign(texels, 1.f);
  flags_.assign(texels, 0);
  row_.assign(texels, -1);
}

void SideContacts::mark(std::size_t texel, int dx, int dy) {
  if (row_[texel] < 0) {
    row_[texel] = static_cast<std::int32_t>(bits_.size() / rowSize());
    bits_.resize(bits_.size() + rowSize(), false);
  }
  bits_[static_cast<std::size_t>(row_[texel]) * rowSize() + bitOf(dx, dy)] = true;
}

void SideContacts::separate(std::size_t texel, int dx, int dy) {
  mark(texel, dx, dy);
  mark(texel + static_cast<std::size_t>(dy * width_ + dx), -dx, -dy);
}

namespace {

constexpr int kFewPlaces = 3;  // of a texel: a pocket of so few is taken for a part of what is around it

class SideBuilder {
 public:
  SideBuilder(const ContactScene& in, const TallySide& side, const SideLines& lines, int radius)
      : in_(in),
        side_(side),
        layout_(in.layout.charts[side.chart]),
        radius_(radius),
        bins_(side.width, side.height, lines),
        groups_(in.charts, in.layout, side.chart, bins_),
        regions_(in, side.chart, side.back, bins_, groups_),
        result_(side.width, side.height, radius),
        main_(bins_.touched().size(), kNone) {}

  SideContacts build() {
    for (std::uint32_t i = 0; i < main_.size(); ++i) {
      result_.touch(bins_.touched()[i]);
      judgeTouched(i);
    }
    for (std::size_t t = 0; t < side_.texelCount(); ++t) {
      if (bins_.indexOf(t) != kNone || !isSurface(t) || regions_.ofTexel(t) == RegionKind::open) continue;
      result_.setShare(t, 0);
      result_.hide(t);
    }
    if (!hasOpen() && !openCut()) return {};
    separateTexels();
    return std::move(result_);
  }

 private:
  bool isSurface(std::size_t texel) const { return in_.layout.area[layout_.firstTexel + texel] > 0; }

  bool hasOpen() const {
    for (std::size_t t = 0; t < side_.texelCount(); ++t)
      if (isSurface(t) && result_.share(t) > 0) return true;
    return false;
  }

  /// Where walls cut all that there is, a mixture is better than nothing.
  bool openCut() {
    for (const std::uint32_t i : cut_) result_.setShare(bins_.touched()[i], 1);
    return !cut_.empty();
  }

  /// Chooses the group that the texel speaks for, and what of it counts.
  void judgeTouched(std::uint32_t i) {
    const std::size_t texel = bins_.touched()[i];
    const PlaceSet surface = groups_.surface(i);
    if (surface == 0) return;  // a sliver between the places
    const auto groups = groups_.of(i);
    int most = 0, stray = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (regions_.ofGroup(groups_.first(i) + g) != RegionKind::open || std::popcount(groups[g]) <= most) continue;
      most = std::popcount(groups[g]);
      main_[i] = static_cast<std::uint32_t>(groups_.first(i) + g);
    }
    if (main_[i] == kNone) {
      result_.setShare(texel, 0);
      return result_.hide(texel);
    }
    bool cut = false;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::size_t number = groups_.first(i) + g;
      const RegionKind kind = regions_.ofGroup(number);
      if (number == main_[i] || kind == RegionKind::shut) continue;
      const int count = std::popcount(groups[g]);
      if (kind == RegionKind::pocket && count <= kFewPlaces) {
        stray += count;
      } else {
        cut = true;
      }
    }
    if (cut) cut_.push_back(i);
    result_.setShare(texel, cut ? 0 : static_cast<double>(most + stray) / std::popcount(surface));
  }

  /// The middle of what the texel speaks for: its own where no contact is.
  Vec2d middle(int x, int y) const {
    const Vec2d corner{static_cast<double>(x), static_cast<double>(y)};
    const std::uint32_t i = bins_.indexOf(texelOf(x, y));
    if (i == kNone || main_[i] == kNone) return corner + Vec2d{0.5, 0.5};
    const PlaceSet group = groups_.of(i)[main_[i] - groups_.first(i)];
    Vec2d sum{}, best{};
    for (PlaceSet left = group; left != 0; left &= left - 1) sum = sum + contactPlace(std::countr_zero(left));
    sum = sum * (1.0 / std::popcount(group));
    double nearest = 1e300;
    for (PlaceSet left = group; left != 0; left &= left - 1) {
      const Vec2d p = contactPlace(std::countr_zero(left)), d = p - sum;
      if (d.x * d.x + d.y * d.y >= nearest) continue;
      nearest = d.x * d.x + d.y * d.y;
      best = p;
    }
    return corner + best;
  }

  std::size_t texelOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_.width) + static_cast<std::size_t>(x);
  }

  /// A line between two texels is in a texel of the rectangle that they span; of each pair the first is looked at.
  void separateTexels() {
    const std::vector<std::uint8_t> near = nearLines();
    for (int y = 0; y < side_.height; ++y) {
      for (int x = 0; x < side_.width; ++x) {
        if (near[texelOf(x, y)] == 0 || result_.hidden(texelOf(x, y))) continue;
        const Vec2d here = middle(x, y);
        for (int dy = 0; dy <= radius_ && y + dy < side_.height; ++dy) {
          for (int dx = dy == 0 ? 1 : -radius_; dx <= radius_; ++dx) {
            if (x + dx < 0 || x + dx >= side_.width || result_.hidden(texelOf(x + dx, y + dy))) continue;
            if (bins_.crossed(here, middle(x + dx, y + dy))) result_.separate(texelOf(x, y), dx, dy);
          }
        }
      }
    }
  }

  /// Texels with a line within the kernel's reach.
  std::vector<std::uint8_t> nearLines() const {
    std::vector<std::uint8_t> near(side_.texelCount(), 0);
    for (const std::uint32_t t : bins_.touched()) {
      if (!bins_.hasLine(t)) continue;
      const int x = static_cast<int>(t) % side_.width, y = static_cast<int>(t) / side_.width;
      for (int v = std::max(0, y - radius_); v <= std::min(side_.height - 1, y + radius_); ++v)
        for (int u = std::max(0, x - radius_); u <= std::min(side_.width - 1, x + radius_); ++u)
          near[texelOf(u, v)] = 1;
    }
    return near;
  }

  const ContactScene& in_;
  const TallySide& side_;
  const ChartLayout& layout_;
  int radius_;
  ContactBins bins_;
  ContactGroups groups_;
  ContactRegions regions_;
  SideContacts result_;
  std::vector<std::uint32_t> main_;  // by touched texel: number of the group that it speaks for
  std::vector<std::uint32_t> cut_;   // touched texels that walls cut
};

}  // namespace

std::vector<SideContacts> findContacts(const Scene& scene, const ChartSet& charts, const TexelLayout& layout,
                                       const TallyLayout& tallies, const RayCaster& caster, int radius) {
  const ContactScene in{scene, charts, layout, caster};
  const ContactFinder finder(scene, charts, layout, caster);
  std::vector<SideContacts> all(tallies.sides.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t s) {
    const TallySide& side = tallies.sides[s];
    const SideLines lines = finder.find(side.chart, side.back);
    if (!lines.empty()) all[s] = SideBuilder(in, side, lines, radius).build();
  });
  return all;
}

}  // namespace lucarne
