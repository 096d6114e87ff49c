#include "dlm/probe.h"

#include <span>

#include "base/error.h"

namespace lucarne {

namespace {

// Four texels of a rectangle and their weights: texel (x, y) has its centre at (x + ½, y + ½).
struct Bilinear {
  std::size_t index[4];
  double weight[4];

  Bilinear(const SideMaps& side, Vec2d st) {
    const double s = std::clamp(st.x - 0.5, 0.0, side.width - 1.0), t = std::clamp(st.y - 0.5, 0.0, side.height - 1.0);
    const int x0 = static_cast<int>(s), y0 = static_cast<int>(t);
    const int x1 = std::min(x0 + 1, side.width - 1), y1 = std::min(y0 + 1, side.height - 1);
    const double fx = s - x0, fy = t - y0;
    const auto at = [&](int x, int y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(side.width) + static_cast<std::size_t>(x);
    };
    index[0] = at(x0, y0), index[1] = at(x1, y0), index[2] = at(x0, y1), index[3] = at(x1, y1);
    weight[0] = (1 - fx) * (1 - fy), weight[1] = fx * (1 - fy), weight[2] = (1 - fx) * fy, weight[3] = fx * fy;
  }

  Rgbd of(std::span<const Rgb> map) const {
    Rgbd sum{};
    for (int i = 0; i < 4; ++i) sum += Rgbd(map[index[i]]) * weight[i];
    return sum;
  }
};

std::size_t texelHolding(const SideMaps& side, Vec2d st) {
  const auto x = static_cast<std::size_t>(std::clamp(st.x, 0.0, side.width - 0.5));
  const auto y = static_cast<std::size_t>(std::clamp(st.y, 0.0, side.height - 0.5));
  return y * static_cast<std::size_t>(side.width) + x;
}

nlohmann::json triple(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

Prober::Prober(const Scene& scene, const LightMaps& maps)
    : maps_(maps), directions_(maps.directionCount, maps.directionFilter), surface_(scene, maps) {}

ProbeAnswer Prober::probe(Vec3d position, Vec3d normal, ProbeDetail detail) const {
  if (!isFinite(position) || !isFinite(normal)) throw InputError("a point or normal has a number that is not finite");
  const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  if (!(largest > 0)) throw InputError("a normal has length zero");
  ProbeAnswer answer;
  const std::optional<SurfacePoint> point = surface_.find(position, normalize(normal / largest));
  if (!point) return answer;
  answer.onSurface = true;
  answer.chart = point->chart;
  answer.back = point->back;
  answer.st = point->st;
  const MapChart& chart = maps_.charts[point->chart];
  const std::uint32_t index = point->back ? chart.backSide : chart.frontSide;
  if (index == kNone) return answer;
  const SideMaps& side = maps_.sides[index];
  if (side.lit) {
    const std::size_t texel = side.firstTexel + texelHolding(side, point->st);
    answer.irradiance = Bilinear(side, point->st).of({maps_.irradiance.data() + side.firstTexel, side.texelCount()});
    answer.standardError = static_cast<double>(maps_.standardError[texel]);
    answer.relativeError = static_cast<double>(maps_.relativeError[texel]);
    answer.photons = static_cast<double>(maps_.photons[texel]);
  }
  fillDirections(side, *point, detail, answer);
  return answer;
}

void Prober::fillDirections(const SideMaps& side, const SurfacePoint& point, ProbeDetail detail,
                            ProbeAnswer& answer) const {
  const Bilinear weights(side, point.st);
  for (const SideDirection& member : side.directions) {
    ProbeDirection out;
    out.psi = member.psi;
    if (detail == ProbeDetail::all) {
      const ClippedCell cell = directions_.clippedCell(member.psi, point.normal);
      out.direction = cell.solidAngle > 0 ? normalize(cell.moment) : directions_.direction(member.psi);
      out.solidAngle = cell.solidAngle;
      out.meanCosine = cell.meanCosine();
    }
    if (member.stored() && !maps_.directional.empty()) out.irradiance = weights.of({maps_.directional.data() + member.first, side.texelCount()});
    answer.directions.push_back(out);
  }
}

nlohmann::json toJson(const ProbeAnswer& answer) {
  if (!answer.onSurface) return {{"irradiance", nullptr}};
  nlohmann::json directions = nlohmann::json::array();
  for (const ProbeDirection& d : answer.directions) {
    directions.push_back({{"psi", d.psi},
                          {"direction", triple(d.direction)},
                          {"irradiance", triple(d.irradiance)},
                          {"solid_angle", d.solidAngle},
                          {"mean_cosine", d.meanCosine}});
  }
  return {{"chart", answer.chart},
          {"side", answer.back ? "back" : "front"},
          {"irradiance", triple(answer.irradiance)},
          {"directions", std::move(directions)},
          {"standard_error", answer.standardError},
          {"estimated_relative_error", answer.relativeError},
          {"photons", answer.photons}};
}

}  // namespace lucarne
