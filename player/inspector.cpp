#include "player/inspector.h"

#include "tracer/transport/pinhole.h"

namespace lucarne {

Inspector::Inspector(const Scene& scene, const LightMaps& maps) : scene_(scene), caster_(scene), prober_(scene, maps) {}

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
  return found;
}

}  // namespace lucarne
