#include "player/inspector.h"

#include "tracer/transport/pinhole.h"

namespace lucarne {

Inspector::Inspector(const Scene& scene, const LightMaps& maps, LightByDirection elsewhere)
    : scene_(scene), maps_(maps), elsewhere_(std::move(elsewhere)), caster_(scene), prober_(scene, maps) {}

void Inspector::fillDirections(ProbeAnswer& answer) const {
  if (answer.directions.empty()) return;
  const MapChart& chart = maps_.charts[answer.chart];
  const std::uint32_t index = answer.back ? chart.backSide : chart.frontSide;
  const std::vector<Rgbd> light = elsewhere_(index, answer.st);
  const std::vector<SideDirection>& members = maps_.sides[index].directions;
  std::size_t rank = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].stored()) answer.directions[i].irradiance = light[rank++];
  }
}

std::optional<Inspection> Inspector::inspect(const Camera& camera, double x, double y, double aspect) const {
  const RayStart ray = Pinhole(camera, aspect, 1).through(x * aspect, y);
  std::uint64_t repeats = 0;
  const std::uint32_t triangle = caster_.nearest(ray.origin, ray.direction, kNone, repeats);
  if (triangle == kNone) return std::nullopt;
  const Hit hit = caster_.intersect(triangle, ray.origin, ray.direction);
  Inspection found;
  found.position = scene_.frame.toWorld(hit.position);
  found.normal = hit.back ? -Vec3d(hit.n) : Vec3d(hit.n);
  found.material = scene_.materials[hit.material].name;
  found.answer = prober_.probe(found.position, found.normal);
  if (elsewhere_) fillDirections(found.answer);
  return found;
}

}  // namespace lucarne
