// Where the stored directional maps go.
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "dlm/dlm_writer_pages.h"
#include "dlm/pack.h"

namespace lucarne {

namespace {

// Readers refuse OpenEXR files of more than 4096 layers; sets of more directions put several ψ on a page.
constexpr std::size_t kMostLayers = 2048;

struct StoredMap {
  std::size_t member;  // counted over all sides
  int width, height;
};

bool isNeutral(const LightMaps& maps, const SideMaps& side, const SideDirection& direction) {
  const auto first = maps.directional.begin() + static_cast<std::ptrdiff_t>(direction.first);
  return std::all_of(first, first + static_cast<std::ptrdiff_t>(side.texelCount()),
                     [](const Rgb& v) { return v.x == v.y && v.x == v.z; });
}

enum class Kind { all, coloured, neutral };

std::vector<std::vector<StoredMap>> storedMapsByPsi(const LightMaps& maps, Kind kind) {
  std::vector<std::vector<StoredMap>> byPsi(static_cast<std::size_t>(maps.directionCount));
  std::size_t member = 0;
  for (const SideMaps& side : maps.sides) {
    for (const SideDirection& direction : side.directions) {
      if (direction.stored() && (kind == Kind::all || (kind == Kind::neutral) == isNeutral(maps, side, direction)))
        byPsi.at(direction.psi).push_back({member, side.width, side.height});
      ++member;
    }
  }
  return byPsi;
}

struct PackedGroup {
  std::size_t firstPsi, psiCount;
  bool neutral;
  std::vector<StoredMap> maps;
  Packing packing;
};

void packGroups(const std::vector<std::vector<StoredMap>>& byPsi, std::size_t psiPerGroup, bool neutral,
                std::vector<PackedGroup>& groups) {
  for (std::size_t first = 0; first < byPsi.size(); first += psiPerGroup) {
    PackedGroup group{first, std::min(psiPerGroup, byPsi.size() - first), neutral, {}, {}};
    std::vector<RectSize> sizes;
    for (std::size_t psi = first; psi < first + group.psiCount; ++psi) {
      for (const StoredMap& map : byPsi[psi]) {
        group.maps.push_back(map);
        sizes.push_back({map.width, map.height});
      }
    }
    if (sizes.empty()) continue;
    group.packing = packRectangles(sizes, PackOptions{});
    groups.push_back(std::move(group));
  }
}

std::size_t layerCount(const std::vector<PackedGroup>& groups) {
  std::size_t count = 0;
  for (const PackedGroup& group : groups) count += static_cast<std::size_t>(group.packing.pageCount);
  return count;
}

std::string layerName(const PackedGroup& group, int page) {
  char text[64];
  const char* kind = group.neutral ? " neutral" : "";
  if (group.psiCount == 1) {
    std::snprintf(text, sizeof text, "psi %03zu%s page %d", group.firstPsi, kind, page);
  } else {
    std::snprintf(text, sizeof text, "psi %03zu-%03zu%s page %d", group.firstPsi, group.firstPsi + group.psiCount - 1,
                  kind, page);
  }
  return text;
}

void checkSize(const DirectionalPages& pages) {
  const auto texels =
      static_cast<std::uint64_t>(pages.width) * static_cast<std::uint64_t>(pages.height) * pages.layers.size();
  if (texels <= kMaxPixels) return;
  throw Error(ExitCode::outOfResource, "the directional maps need " + std::to_string(texels) +
                                           " texels, more than the " + std::to_string(kMaxPixels) +
                                           " of a file; lower the density or the directions");
}

}  // namespace

DirectionalPages packDirectional(const LightMaps& maps, bool neutralApart) {
  const auto byPsi = storedMapsByPsi(maps, neutralApart ? Kind::coloured : Kind::all);
  const auto neutral = neutralApart ? storedMapsByPsi(maps, Kind::neutral) : decltype(byPsi){};
  std::vector<PackedGroup> groups;
  for (std::size_t psiPerGroup = 1;; psiPerGroup *= 2) {
    groups.clear();
    packGroups(byPsi, psiPerGroup, false, groups);
    packGroups(neutral, psiPerGroup, true, groups);
    if (layerCount(groups) <= kMostLayers || psiPerGroup >= byPsi.size()) break;
  }

  DirectionalPages pages;
  std::size_t members = 0;
  for (const SideMaps& side : maps.sides) members += side.directions.size();
  pages.places.assign(members, DirectionalPages::kNotStored);
  for (const PackedGroup& group : groups) {
    pages.width = std::max(pages.width, group.packing.pageWidth);
    pages.height = std::max(pages.height, group.packing.pageHeight);
  }
  for (const PackedGroup& group : groups) {
    const auto firstLayer = static_cast<std::int64_t>(pages.layers.size());
    for (int page = 0; page < group.packing.pageCount; ++page) pages.layers.push_back(layerName(group, page));
    pages.neutral.resize(pages.layers.size(), group.neutral);
    for (std::size_t i = 0; i < group.maps.size(); ++i) {
      const Placement& at = group.packing.places[i];
      pages.places[group.maps[i].member] = at.x + pages.width * (at.y + pages.height * (firstLayer + at.page));
    }
  }
  checkSize(pages);
  return pages;
}

}  // namespace lucarne
