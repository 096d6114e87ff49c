// The surface of texels that a contact touches, in groups of places that see each other along it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dlm/contact_bins.h"

namespace lucarne {

inline constexpr int kContactPlaces = 64;

/// Place `i` of a texel, from its corner: low discrepancy.
Vec2d contactPlace(int i);

/// Places of one texel: a bit each.
using PlaceSet = std::uint64_t;

class ContactGroups {
 public:
  /// `bins` must outlive this.
  ContactGroups(const ChartSet& charts, const TexelLayout& layout, std::uint32_t chart, const ContactBins& bins);

  /// Places of a touched texel that are on the chart's surface.
  PlaceSet surface(std::uint32_t touched) const { return surface_[touched]; }
  /// Those that are under no cover, parted where a line runs between them. Groups are numbered through.
  std::span<const PlaceSet> of(std::uint32_t touched) const {
    return std::span(groups_).subspan(first_[touched], first_[touched + 1] - first_[touched]);
  }
  std::size_t first(std::uint32_t touched) const { return first_[touched]; }
  std::size_t count() const { return groups_.size(); }

 private:
  void findSurface(const ChartSet& charts, std::uint32_t chart);
  std::vector<PlaceSet> groupsOf(std::uint32_t touched) const;

  const ContactBins& bins_;
  ChartLayout layout_;
  std::vector<PlaceSet> surface_;  // by touched texel
  std::vector<PlaceSet> groups_;
  std::vector<std::size_t> first_;
};

}  // namespace lucarne
