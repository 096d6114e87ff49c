#include "dlm/contact_regions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "dlm/contact_rays.h"

namespace lucarne {
namespace {

constexpr int kLooksAcross = 8;         // places of a group that look for those of a neighbour
constexpr double kSmallest = 3;         // texels that an open region has, at least
constexpr double kWidest = 0.5;         // of a texel, and the share that it has of some texel
constexpr std::size_t kPlacesCast = 8;  // a region

/// The places of a group that are nearest to a point.
std::vector<Vec2d> nearestPlaces(PlaceSet group, Vec2d corner, Vec2d point) {
  std::vector<std::pair<double, int>> order;
  for (; group != 0; group &= group - 1) {
    const int i = std::countr_zero(group);
    const Vec2d d = corner + contactPlace(i) - point;
    order.emplace_back(d.x * d.x + d.y * d.y, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Vec2d> places;
  for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), kLooksAcross); ++i)
    places.push_back(corner + contactPlace(order[i].second));
  return places;
}

}  // namespace

ContactRegions::ContactRegions(const ContactScene& in, std::uint32_t chart, bool back, const ContactBins& bins,
                               const ContactGroups& groups)
    : in_(in), chart_(chart), back_(back), bins_(bins), groups_(groups), layout_(in.layout.charts[chart]) {
  region_.resize(groups.count() + layout_.texelCount());
  std::iota(region_.begin(), region_.end(), 0u);
  join();
  for (std::uint32_t n = 0; n < region_.size(); ++n) region_[n] = find(n);
  judge();
}

std::uint32_t ContactRegions::find(std::uint32_t node) {
  while (region_[node] != node) node = region_[node] = region_[region_[node]];
  return node;
}

bool ContactRegions::isSurface(std::size_t texel) const { return in_.layout.area[layout_.firstTexel + texel] > 0; }

void ContactRegions::join() {
  const auto width = static_cast<std::uint32_t>(layout_.width), height = static_cast<std::uint32_t>(layout_.height);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t t = y * width + x;
      if (x + 1 < width) joinTexels(t, t + 1, {x + 1.0, y + 0.5});
      if (y + 1 < height) joinTexels(t, t + width, {x + 0.5, y + 1.0});
    }
  }
}

/// `border`: the middle of the edge between the two texels.
void ContactRegions::joinTexels(std::uint32_t a, std::uint32_t b, Vec2d border) {
  struct Looker {
    std::uint32_t node;
    std::vector<Vec2d> places;
  };
  const auto lookers = [&](std::uint32_t texel) {
    const auto width = static_cast<std::uint32_t>(layout_.width);
    const Vec2d corner{static_cast<double>(texel % width), static_cast<double>(texel / width)};
    const std::uint32_t touched = bins_.indexOf(texel);
    std::vector<Looker> all;
    if (touched == kNone) {
      all.push_back({static_cast<std::uint32_t>(groups_.count()) + texel, {corner + Vec2d{0.5, 0.5}}});
    } else {
      for (const PlaceSet& group : groups_.of(touched))
        all.push_back(
            {static_cast<std::uint32_t>(groups_.first(touched) + all.size()), nearestPlaces(group, corner, border)});
    }
    return all;
  };
  if (!isSurface(a) || !isSurface(b)) return;
  const auto unite = [this](std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    region_[std::max(i, j)] = std::min(i, j);
  };
  if (bins_.indexOf(a) == kNone && bins_.indexOf(b) == kNone) {
    const auto first = static_cast<std::uint32_t>(groups_.count());
    return unite(first + a, first + b);
  }
  const std::vector<Looker> there = lookers(b);
  for (const Looker& l : lookers(a)) {
    for (const Looker& m : there) {
      const bool sees = std::any_of(l.places.begin(), l.places.end(), [&](Vec2d p) {
        return std::any_of(m.places.begin(), m.places.end(), [&](Vec2d q) { return !bins_.crossed(p, q); });
      });
      if (sees) unite(l.node, m.node);
    }
  }
}

std::vector<ContactRegions::Place> ContactRegions::placesOfRegions() const {
  std::vector<Place> all;
  const auto width = static_cast<std::uint32_t>(layout_.width);
  for (std::uint32_t t = 0; t < layout_.texelCount(); ++t) {
    const Vec2d corner{static_cast<double>(t % width), static_cast<double>(t / width)};
    const std::uint32_t touched = bins_.indexOf(t);
    if (touched == kNone) {
      if (isSurface(t)) all.push_back({region_[groups_.count() + t], corner + Vec2d{0.5, 0.5}});
      continue;
    }
    std::size_t g = groups_.first(touched);
    for (const PlaceSet& group : groups_.of(touched))
      all.push_back({region_[g++], corner + contactPlace(std::countr_zero(group))});
  }
  std::stable_sort(all.begin(), all.end(), [](const Place& a, const Place& b) { return a.region < b.region; });
  std::vector<Place> some;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].region == all[i].region) ++end;
    const std::size_t count = std::min(end - i, kPlacesCast);
    for (std::size_t k = 0; k < count; ++k) some.push_back(all[i + k * (end - i) / count]);
    i = end;
  }
  return some;
}

void ContactRegions::findShut(const std::vector<Place>& places) {
  std::vector<Vec2d> st;
  for (const Place& p : places) st.push_back(p.st);
  const std::vector<RayVotes> votes = castFromChart(in_, chart_, back_, st);
  for (std::size_t i = 0; i < places.size();) {
    RayVotes sum;
    const std::uint32_t region = places[i].region;
    for (; i < places.size() && places[i].region == region; ++i) {
      sum.rays += votes[i].rays;
      sum.backs += votes[i].backs;
      sum.blackBacks += votes[i].blackBacks;
      sum.soles += votes[i].soles;
    }
    const int most = 2 * sum.rays / 3;
    if (sum.blackBacks > most || (sum.backs > most && sum.soles > most)) kinds_[region] = RegionKind::shut;
  }
}

void ContactRegions::judge() {
  kinds_.assign(region_.size(), RegionKind::open);
  findShut(placesOfRegions());
  std::vector<double> size(region_.size()), widest(region_.size());
  const auto count = [&](std::size_t node, double share) {
    size[region_[node]] += share;
    widest[region_[node]] = std::max(widest[region_[node]], share);
  };
  for (std::uint32_t t = 0; t < layout_.texelCount(); ++t) {
    const std::uint32_t touched = bins_.indexOf(t);
    if (touched == kNone) {
      if (isSurface(t)) count(groups_.count() + t, 1);
      continue;
    }
    std::size_t g = groups_.first(touched);
    for (const PlaceSet& group : groups_.of(touched)) count(g++, std::popcount(group) / double{kContactPlaces});
  }
  std::size_t largest = 0;
  for (std::size_t r = 0; r < size.size(); ++r) {
    if (kinds_[r] != RegionKind::shut && (size[r] > size[largest] || kinds_[largest] == RegionKind::shut)) largest = r;
  }
  for (std::size_t r = 0; r < size.size(); ++r) {
    if (r != largest && kinds_[r] == RegionKind::open && (size[r] < kSmallest || widest[r] < kWidest))
      kinds_[r] = RegionKind::pocket;
  }
}

}  // namespace lucarne
