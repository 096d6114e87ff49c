#include <algorithm>
#include <limits>

#include "base/image_file.h"
#include "dlm/direction_set_cells.h"
#include "dlm/manifest.h"
#include "dlm/manifest_cover.h"
#include "dlm/mean_direction.h"
#include "tracer/scene/gltf_json.h"

namespace lucarne {

namespace {

constexpr std::int64_t kLargestPage = 1 << 20;

const Json& member(const Json& object, const char* key, const Place& place) {
  const Json* found = findMember(object, key);
  if (found == nullptr) place.in(key).fail("is missing");
  return *found;
}

// An array member; of `count` elements unless `count` is kAnyCount.
constexpr std::size_t kAnyCount = ~std::size_t{0};
const Json& list(const Json& object, const char* key, std::size_t count, const Place& place) {
  const Json& found = member(object, key, place);
  if (!found.is_array()) place.in(key).fail("is not an array");
  if (count != kAnyCount && found.size() != count) {
    place.in(key).fail("has " + std::to_string(found.size()) + " elements, not " + std::to_string(count));
  }
  return found;
}

// Whole numbers between `lo` and `hi`.
std::vector<std::int64_t> integers(const Json& object, const char* key, std::size_t count, std::int64_t lo,
                                   std::int64_t hi, const Place& place) {
  const Json& elements = list(object, key, count, place);
  std::vector<std::int64_t> values;
  values.reserve(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Json& element = elements[i];
    const bool fits = element.is_number_integer() &&
                      (!element.is_number_unsigned() || element.get<std::uint64_t>() <= std::uint64_t{1} << 62);
    const std::int64_t value = fits ? element.get<std::int64_t>() : 0;
    if (!fits || value < lo || value > hi) {
      place.in(key, i).fail("is not a whole number from " + std::to_string(lo) + " to " + std::to_string(hi));
    }
    values.push_back(value);
  }
  return values;
}

std::vector<double> reals(const Json& object, const char* key, std::size_t count, const Place& place) {
  const Json& elements = list(object, key, count, place);
  std::vector<double> values;
  values.reserve(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!elements[i].is_number()) place.in(key, i).fail("is not a number");
    values.push_back(elements[i].get<double>());
    if (!std::isfinite(values.back())) place.in(key, i).fail("is not finite");
  }
  return values;
}

std::vector<std::string> names(const Json& object, const char* key, const Place& place) {
  std::vector<std::string> values;
  const Json& elements = list(object, key, kAnyCount, place);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!elements[i].is_string()) place.in(key, i).fail("is not a text");
    values.push_back(elements[i].get<std::string>());
  }
  return values;
}

const Json& section(const Json& manifest, const char* key, const Place& file) {
  const Json& found = member(manifest, key, file);
  if (!found.is_object()) file.in(key).fail("is not an object");
  return found;
}

void checkFormat(const Json& manifest, const Place& file) {
  if (!manifest.is_object() || textOf(manifest, "format", "", file) != dlm_file::kFormat) {
    file.fail(std::string("is not the manifest of light maps (no \"format\": \"") + dlm_file::kFormat + "\")");
  }
  const std::uint64_t version = requiredCount(manifest, "version", file);
  if (version != dlm_file::kVersion) {
    file.fail("is of version " + std::to_string(version) + "; this program reads version " +
              std::to_string(dlm_file::kVersion));
  }
}

// The set is rebuilt from its count; a file whose directions lie elsewhere was made by a program that spreads them
// otherwise.
int readDirections(const Json& manifest, const Place& file) {
  const Place place = file.in("directions");
  const Json& directions = section(manifest, "directions", file);
  const std::uint64_t count = requiredCount(directions, "count", place);
  if (count < 1 || count > 65535) place.in("count").fail("is not from 1 to 65535");
  const Json& rows = list(directions, "list", count, place);
  const std::vector<Vec3d> expected = spreadDirections(static_cast<int>(count));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json& row = rows[i];
    bool same = row.is_array() && row.size() == 3;
    for (std::size_t k = 0; same && k < 3; ++k) {
      same = row[k].is_number() && std::abs(row[k].get<double>() - expected[i][static_cast<int>(k)]) < 1e-9;
    }
    if (!same) place.in("list", i).fail("is not the direction that this program gives to the set; bake again");
  }
  return static_cast<int>(count);
}

/// Manifests of before there was a choice name none.
DirectionFilter filterOf(const Json& manifest, const Place& file) {
  const Place place = file.in("directions");
  const std::string name = textOf(section(manifest, "directions", file), "filter", "nearest", place);
  for (const DirectionFilter filter : {DirectionFilter::nearest, DirectionFilter::linear})
    if (name == nameOf(filter)) return filter;
  place.in("filter").fail("is one that this program does not know");
}

void readCharts(const Json& manifest, const Place& file, LightMaps& maps) {
  const Place place = file.in("charts");
  const Json& charts = section(manifest, "charts", file);
  const std::size_t n = list(charts, "material", kAnyCount, place).size();
  constexpr std::int64_t kMaxIndex = std::numeric_limits<std::int32_t>::max();
  const auto material = integers(charts, "material", n, 0, kMaxIndex, place);
  const auto smooth = integers(charts, "smooth", n, 0, 1, place), planar = integers(charts, "planar", n, 0, 1, place);
  const auto front = integers(charts, "front", n, -1, kMaxIndex, place);
  const auto back = integers(charts, "back", n, -1, kMaxIndex, place);
  const auto rectangle = integers(charts, "rectangle", 4 * n, 0, kLargestPage, place);
  const auto normal = reals(charts, "normal", 3 * n, place), texelSize = reals(charts, "texel_size", n, place);
  maps.charts.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    MapChart& chart = maps.charts[i];
    chart.material = static_cast<std::uint32_t>(material[i]);
    chart.smooth = smooth[i] != 0;
    chart.planar = planar[i] != 0;
    chart.normal = Vec3f(Vec3d{normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]});
    if (std::abs(length(chart.normal) - 1) > 1e-3f) place.in("normal", 3 * i).fail("does not begin a unit vector");
    chart.texelSize = texelSize[i];
    if (!(chart.texelSize > 0)) place.in("texel_size", i).fail("is not positive");
    chart.frontSide = front[i] < 0 ? kNone : static_cast<std::uint32_t>(front[i]);
    chart.backSide = back[i] < 0 ? kNone : static_cast<std::uint32_t>(back[i]);
    chart.atlasX = static_cast<int>(rectangle[4 * i]);
    chart.atlasY = static_cast<int>(rectangle[4 * i + 1]);
    chart.width = static_cast<int>(rectangle[4 * i + 2]);
    chart.height = static_cast<int>(rectangle[4 * i + 3]);
  }
}

void checkAtlas(const Place& file, const LightMaps& maps) {
  PageCover cover(maps.atlasWidth, maps.atlasHeight, 1);
  for (std::size_t i = 0; i < maps.charts.size(); ++i) {
    const MapChart& chart = maps.charts[i];
    if (!cover.add(chart.atlasX, chart.atlasY, 0, chart.width, chart.height)) {
      file.in("charts")
          .in("rectangle", 4 * i)
          .fail("begins a rectangle that is empty, leaves the page or covers another");
    }
  }
}

void readMembers(SideMaps& side, const std::int64_t* psi, const Place& place, std::size_t first) {
  for (std::size_t k = 0; k < side.directions.size(); ++k) {
    side.directions[k].psi = static_cast<std::uint16_t>(psi[k]);
    if (k > 0 && psi[k] <= psi[k - 1]) place.in("psi", first + k).fail("is not larger than the one before");
  }
}

void readSides(const Json& manifest, const Place& file, ManifestContents& contents) {
  const Place place = file.in("sides");
  LightMaps& maps = contents.maps;
  const Json& sides = section(manifest, "sides", file);
  const std::size_t n = list(sides, "chart", kAnyCount, place).size();
  const std::size_t memberCount = list(sides, "psi", kAnyCount, place).size();
  const auto chart = integers(sides, "chart", n, 0, static_cast<std::int64_t>(maps.charts.size()) - 1, place);
  const auto back = integers(sides, "back", n, 0, 1, place), lit = integers(sides, "lit", n, 0, 1, place);
  const auto members = integers(sides, "members", n, 0, maps.directionCount, place);
  const auto psi = integers(sides, "psi", memberCount, 0, maps.directionCount - 1, place);
  contents.pages.directional.places = integers(sides, "place", memberCount, DirectionalPages::kNotStored,
                                               std::numeric_limits<std::int64_t>::max(), place);
  std::size_t first = 0;
  maps.sides.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    SideMaps& side = maps.sides[i];
    const MapChart& owner = maps.charts[static_cast<std::size_t>(chart[i])];
    side.chart = static_cast<std::uint32_t>(chart[i]);
    side.back = back[i] != 0;
    side.lit = lit[i] != 0;
    if ((side.back ? owner.backSide : owner.frontSide) != i)
      place.in("chart", i).fail("names a chart without this side");
    side.width = owner.width;
    side.height = owner.height;
    const auto count = static_cast<std::size_t>(members[i]);
    if (count > memberCount - first) place.in("members", i).fail("goes beyond the list of psi");
    side.directions.resize(count);
    readMembers(side, psi.data() + first, place, first);
    first += count;
  }
  if (first != memberCount) place.in("psi").fail("has more elements than the sides have members");
}

// Every side that a chart names exists and names the chart: together with readSides, they are one to one.
void checkSidesOfCharts(const Place& file, const LightMaps& maps) {
  for (std::size_t i = 0; i < maps.charts.size(); ++i) {
    for (const bool back : {false, true}) {
      const std::uint32_t index = back ? maps.charts[i].backSide : maps.charts[i].frontSide;
      if (index == kNone) continue;
      if (index >= maps.sides.size() || maps.sides[index].chart != i || maps.sides[index].back != back) {
        file.in("charts").in(back ? "back" : "front", i).fail("names no side of this chart");
      }
    }
  }
}

/// Manifests of before there was a choice name none: the channels then say what they are.
MapFormat formatOf(const Json& directional, const Place& place) {
  const std::string name = textOf(directional, "format", "half", place);
  for (const MapFormat f : {MapFormat::half, MapFormat::float32, MapFormat::rgb9e5, MapFormat::ldr8})
    if (name == nameOf(f)) return f;
  place.in("format").fail("is one that this program does not know");
}

std::vector<float> mapScales(const Json& directional, const Place& place) {
  std::vector<float> scales;
  for (const double v : reals(directional, "map_scales", kAnyCount, place)) {
    scales.push_back(static_cast<float>(v));
    if (!(scales.back() >= 0 && std::isfinite(scales.back()))) place.in("map_scales", scales.size() - 1).fail("is negative or too large");
  }
  return scales;
}

/// Manifests of before there were mean directions, or of maps without, have none.
bool readMeans(const Json& directional, const LightMaps& maps, const Place& place) {
  const Json* means = findMember(directional, "means");
  if (means == nullptr || means->is_null()) return false;
  const Place here = place.in("means");
  if (!means->is_object()) here.fail("is not an object");
  const double reach = numberOf(*means, "reach", 0, here),
               expected = static_cast<double>(meanReach(maps.directionCount, maps.directionFilter));
  if (!(std::abs(reach - expected) <= 1e-6 * expected)) here.in("reach").fail("is not " + std::to_string(expected));
  return true;
}

void readPages(const Json& manifest, const Place& file, ManifestContents& contents) {
  const Json& irradiance = section(manifest, "irradiance", file);
  const auto size = integers(irradiance, "size", 2, 0, kLargestPage, file.in("irradiance"));
  contents.maps.atlasWidth = static_cast<int>(size[0]);
  contents.maps.atlasHeight = static_cast<int>(size[1]);
  contents.pages.irradianceLayers = names(irradiance, "layers", file.in("irradiance"));
  if (static_cast<std::uint64_t>(size[0] * size[1]) > kMaxPixels) file.in("irradiance").in("size").fail("is too large");

  const Json& directional = member(manifest, "directional", file);
  if (directional.is_null()) return;
  const Place place = file.in("directional");
  if (!directional.is_object()) place.fail("is not an object");
  DirectionalPages& pages = contents.pages.directional;
  const auto pageSize = integers(directional, "size", 2, 1, kLargestPage, place);
  pages.width = static_cast<int>(pageSize[0]);
  pages.height = static_cast<int>(pageSize[1]);
  pages.layers = names(directional, "layers", place);
  pages.scale = numberOf(directional, "scale", 1, place);
  pages.format = formatOf(directional, place);
  if (pages.format == MapFormat::ldr8) pages.mapScales = mapScales(directional, place);
  pages.means = readMeans(directional, contents.maps, place);
  int exponent = 0;
  if (!(pages.scale > 0) || std::frexp(pages.scale, &exponent) != 0.5) place.in("scale").fail("is not a power of two");
  if (static_cast<std::uint64_t>(pageSize[0] * pageSize[1]) >
      kMaxPixels / std::max<std::size_t>(1, pages.layers.size())) {
    place.in("size").fail("is too large");
  }
}

// Numbers the texels: sides in order, in each its directions in order.
void placeTexels(const Place& file, ManifestContents& contents) {
  LightMaps& maps = contents.maps;
  const DirectionalPages& pages = contents.pages.directional;
  PageCover cover(pages.width, pages.height, static_cast<std::int64_t>(pages.layers.size()));
  std::uint64_t texels = 0, directional = 0;
  std::size_t k = 0;
  for (SideMaps& side : maps.sides) {
    if (side.lit) side.firstTexel = std::exchange(texels, texels + side.texelCount());
    for (SideDirection& direction : side.directions) {
      const std::int64_t place = pages.places[k++];
      if (place == DirectionalPages::kNotStored) continue;
      if (!side.lit || !cover.addAt(place, side.width, side.height)) {
        file.in("sides")
            .in("place", k - 1)
            .fail(side.lit ? "is outside the pages or covers another map" : "is on an unlit side");
      }
      direction.first = std::exchange(directional, directional + side.texelCount());
    }
  }
  const auto stored = static_cast<std::size_t>(
      std::count_if(pages.places.begin(), pages.places.end(), [](std::int64_t p) { return p != DirectionalPages::kNotStored; }));
  if (pages.format == MapFormat::ldr8 && pages.mapScales.size() != stored)
    file.in("directional").in("map_scales").fail("has " + std::to_string(pages.mapScales.size()) + " elements, not " + std::to_string(stored));
  contents.texelCount = texels;
  contents.directionalCount = directional;
}

}  // namespace

ManifestContents readManifestMaps(const nlohmann::json& manifest, const std::string& name) {
  const Place file(name);
  checkFormat(manifest, file);
  ManifestContents contents;
  contents.maps.directionCount = readDirections(manifest, file);
  contents.maps.directionFilter = filterOf(manifest, file);
  readPages(manifest, file, contents);
  readCharts(manifest, file, contents.maps);
  checkAtlas(file, contents.maps);
  readSides(manifest, file, contents);
  checkSidesOfCharts(file, contents.maps);
  placeTexels(file, contents);
  return contents;
}

}  // namespace lucarne
