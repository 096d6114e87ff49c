#include "dlm/manifest.h"

#include <algorithm>

#include "base/error.h"
#include "dlm/direction_set_cells.h"
#include "dlm/mean_direction.h"

namespace lucarne {

namespace {

using nlohmann::json;

json triple(Vec3d v) { return {v.x, v.y, v.z}; }

// −1 for none, so that a reader in any language takes it for what it is.
json indexOrNone(std::uint32_t index) { return index == kNone ? json(-1) : json(index); }

json describeDirections(int count, DirectionFilter filter) {
  json list = json::array();
  for (const Vec3d& d : spreadDirections(count)) list.push_back(triple(d));
  json result = {{"count", count}, {"list", std::move(list)}};
  if (filter != DirectionFilter::nearest) result["filter"] = nameOf(filter);
  return result;
}

// One array a property: a hundred thousand charts are parsed in a fraction of the time that as many objects take.
json describeCharts(const std::vector<MapChart>& charts) {
  json material = json::array(), smooth = json::array(), planar = json::array(), normal = json::array();
  json texelSize = json::array(), rectangle = json::array(), front = json::array(), back = json::array();
  for (const MapChart& chart : charts) {
    material.push_back(chart.material);
    smooth.push_back(chart.smooth ? 1 : 0);
    planar.push_back(chart.planar ? 1 : 0);
    for (int i = 0; i < 3; ++i) normal.push_back(static_cast<double>(chart.normal[i]));
    texelSize.push_back(chart.texelSize);
    for (const int v : {chart.atlasX, chart.atlasY, chart.width, chart.height}) rectangle.push_back(v);
    front.push_back(indexOrNone(chart.frontSide));
    back.push_back(indexOrNone(chart.backSide));
  }
  return {{"count", charts.size()},
          {"material", std::move(material)},
          {"smooth", std::move(smooth)},
          {"planar", std::move(planar)},
          {"normal", std::move(normal)},
          {"texel_size", std::move(texelSize)},
          {"rectangle", std::move(rectangle)},
          {"front", std::move(front)},
          {"back", std::move(back)}};
}

json describeSides(const std::vector<SideMaps>& sides, const std::vector<std::int64_t>& places) {
  json chart = json::array(), back = json::array(), lit = json::array();
  json members = json::array(), psi = json::array();
  for (const SideMaps& side : sides) {
    chart.push_back(side.chart);
    back.push_back(side.back ? 1 : 0);
    lit.push_back(side.lit ? 1 : 0);
    members.push_back(side.directions.size());
    for (const SideDirection& direction : side.directions) psi.push_back(direction.psi);
  }
  LUCARNE_CHECK_EQ(psi.size(), places.size());
  return {{"count", sides.size()}, {"chart", std::move(chart)},     {"back", std::move(back)},
          {"lit", std::move(lit)}, {"members", std::move(members)}, {"psi", std::move(psi)},
          {"place", places}};
}

json describeDirectional(const DirectionalPages& pages, const LightMaps& maps) {
  if (pages.layers.empty()) return nullptr;
  json result = {{"file", dlm_file::kDirectional},
                 {"size", {pages.width, pages.height}},
                 {"format", nameOf(pages.format)},
                 {"scale", pages.scale},
                 {"layers", pages.layers}};
  if (pages.format == MapFormat::ldr8) result["map_scales"] = pages.mapScales;
  if (pages.means)
    result["means"] = {{"file", dlm_file::kMoments}, {"reach", static_cast<double>(meanReach(maps.directionCount, maps.directionFilter))}};
  return result;
}

}  // namespace

bool hasLitBack(const LightMaps& maps) {
  return std::any_of(maps.sides.begin(), maps.sides.end(), [](const SideMaps& side) { return side.back && side.lit; });
}

nlohmann::json describeMaps(const LightMaps& maps, const LocalFrame& frame, const PageLayout& pages) {
  return {{"format", dlm_file::kFormat},
          {"version", dlm_file::kVersion},
          {"frame", {{"origin", triple(frame.origin)}, {"scale", frame.scale}}},
          {"directions", describeDirections(maps.directionCount, maps.directionFilter)},
          {"charts", describeCharts(maps.charts)},
          {"sides", describeSides(maps.sides, pages.directional.places)},
          {"irradiance",
           {{"file", dlm_file::kIrradiance},
            {"size", {maps.atlasWidth, maps.atlasHeight}},
            {"layers", pages.irradianceLayers}}},
          {"directional", describeDirectional(pages.directional, maps)}};
}

}  // namespace lucarne
