// Which parts of a chart side light can reach.
//
// Groups of places (contact_groups.h) of neighbouring texels that see each other along the surface join into regions; a
// texel without contact is one group. A region is
//   shut    inside of a solid: most rays from it meet backs of one-sided triangles; or of any, and the sole of the
//           solid is under most of it (a chest whose material is two-sided);
//   pocket  no wider than a table leg: less than three texels, or nowhere half a texel. Whatever goes on in there (it
//   may
//           be the inside of a leg whose material is two-sided), its light is no light of the surface around it;
//   open    else. The largest region of a side that is not shut is always open.
#pragma once

#include "dlm/contact_groups.h"

namespace lucarne {

enum class RegionKind : std::uint8_t { open, pocket, shut };

struct ContactScene {
  const Scene& scene;
  const ChartSet& charts;
  const TexelLayout& layout;
  const RayCaster& caster;
};

class ContactRegions {
 public:
  ContactRegions(const ContactScene& in, std::uint32_t chart, bool back, const ContactBins& bins,
                 const ContactGroups& groups);

  /// Of a group, by its number.
  RegionKind ofGroup(std::size_t group) const { return kinds_[region_[group]]; }
  /// Of a texel that no contact touches, with surface.
  RegionKind ofTexel(std::size_t texel) const { return kinds_[region_[groups_.count() + texel]]; }
  /// Number of the region, for comparison.
  std::uint32_t regionOfGroup(std::size_t group) const { return region_[group]; }

 private:
  struct Place {  // to cast rays from
    std::uint32_t region;
    Vec2d st;
  };
  void join();
  void joinTexels(std::uint32_t a, std::uint32_t b, Vec2d border);
  void judge();
  std::vector<Place> placesOfRegions() const;
  void findShut(const std::vector<Place>& places);
  std::uint32_t find(std::uint32_t node);
  bool isSurface(std::size_t texel) const;

  const ContactScene& in_;
  std::uint32_t chart_;
  bool back_;
  const ContactBins& bins_;
  const ContactGroups& groups_;
  const ChartLayout& layout_;
  std::vector<std::uint32_t> region_;  // by node: groups, then texels; union-find while joining
  std::vector<RegionKind> kinds_;      // by region, which is a node
};

}  // namespace lucarne
