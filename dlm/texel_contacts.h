// What contacts do to the texels of a chart side (contact_lines.h, contact_regions.h), for resolve.h and
// texel_gather.h.
//
//   share      the part of a texel's surface that light reaches: what is under a cover or inside of a solid does not
//              count, or the texel would be too dark. A texel that a wall cuts, with surface of open regions on both
//              sides, counts as nothing: its tally is a mixture that neither side may use; such texels take
//              their values from their neighbours on the side where most of their surface is.
//   separated  pairs of texels with a line between them, from the middle of the open surface of the one to that of the
//              other. They share no kernel.
//
// A pure function of scene, layout and the reach of the kernel. Sides without contacts have neither and cost nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/charts.h"
#include "dlm/tally.h"
#include "dlm/texel_layout.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

class SideContacts {
 public:
  /// Nothing is known: all surface is open, nothing is separated.
  SideContacts() = default;
  /// Pairs up to `radius` texels apart along each axis may be separated.
  SideContacts(int width, int height, int radius);

  bool empty() const { return share_.empty(); }
  /// In [0, 1]; 0: the texel gives nothing to any.
  double share(std::size_t texel) const { return share_.empty() ? 1 : static_cast<double>(share_[texel]); }
  /// The texel has no surface that light reaches, and sees none around it: it takes a neighbour's value as it is.
  bool hidden(std::size_t texel) const { return !share_.empty() && (flags_[texel] & kHidden) != 0; }
  /// Whether a line parts the texel from that at (dx, dy) from it; false beyond the radius.
  bool separated(std::size_t texel, int dx, int dy) const {
    if (share_.empty() || row_[texel] < 0 || std::abs(dx) > radius_ || std::abs(dy) > radius_) return false;
    return bits_[static_cast<std::size_t>(row_[texel]) * rowSize() + bitOf(dx, dy)];
  }

  /// A line or a cover is in the texel, or at its border.
  bool touched(std::size_t texel) const { return !share_.empty() && (flags_[texel] & kTouched) != 0; }

  void setShare(std::size_t texel, double share) { share_[texel] = static_cast<float>(share); }
  void hide(std::size_t texel) { flags_[texel] |= kHidden; }
  void touch(std::size_t texel) { flags_[texel] |= kTouched; }
  /// Both ways.
  void separate(std::size_t texel, int dx, int dy);

 private:
  static constexpr std::uint8_t kHidden = 1, kTouched = 2;
  std::size_t rowSize() const { return static_cast<std::size_t>((2 * radius_ + 1) * (2 * radius_ + 1)); }
  std::size_t bitOf(int dx, int dy) const {
    return static_cast<std::size_t>((dy + radius_) * (2 * radius_ + 1) + dx + radius_);
  }
  void mark(std::size_t texel, int dx, int dy);

  int width_ = 0, radius_ = 0;
  std::vector<float> share_;
  std::vector<std::uint8_t> flags_;
  std::vector<std::int32_t> row_;  // by texel, of bits_; −1: separated from none
  std::vector<bool> bits_;
};

/// By side of the tallies. Casts rays; takes the threads of the arena that it is called in.
std::vector<SideContacts> findContacts(const Scene& scene, const ChartSet& charts, const TexelLayout& layout,
                                       const TallyLayout& tallies, const RayCaster& caster, int radius);

}  // namespace lucarne
