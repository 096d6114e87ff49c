// What lies under a pixel, and what the light maps say of it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dlm/probe.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

struct Inspection {
  Vec3d position{}, normal{};  // metres of the file's world; unit, toward the eye
  std::string material;
  ProbeAnswer answer;
};

class Inspector {
 public:
  /// Both must outlive this. Builds a tree of the triangles.
  Inspector(const Scene& scene, const LightMaps& maps);

  /// (x, y): 0 … 1 over the picture, from its upper left corner; `aspect`: width over height. None where there is no
  /// surface. Holes of masks count as surface.
  std::optional<Inspection> inspect(const Camera& camera, double x, double y, double aspect) const;

 private:
  const Scene& scene_;
  RayCaster caster_;
  Prober prober_;
};

}  // namespace lucarne
