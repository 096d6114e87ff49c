// What lies under a pixel, and what the light maps say of it.
#pragma once

#include <functional>
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

/// Light of the stored maps of a side of LightMaps::sides at texel coordinates of its rectangle, in their order, lx.
using LightByDirection = std::function<std::vector<Rgbd>(std::uint32_t side, Vec2d st)>;

class Inspector {
 public:
  /// Both must outlive this. Builds a tree of the triangles. `elsewhere` tells the light by direction where its texels are not
  /// in memory.
  Inspector(const Scene& scene, const LightMaps& maps, LightByDirection elsewhere = {});

  /// (x, y): 0 … 1 over the picture, from its upper left corner; `aspect`: width over height. None where there is no
  /// surface. Holes of masks count as surface.
  std::optional<Inspection> inspect(const Camera& camera, double x, double y, double aspect) const;

 private:
  void fillDirections(ProbeAnswer& answer) const;

  const Scene& scene_;
  const LightMaps& maps_;
  LightByDirection elsewhere_;
  RayCaster caster_;
  Prober prober_;
};

}  // namespace lucarne
