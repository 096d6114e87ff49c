// What the light maps say at a point of the scene.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/vec.h"
#include "dlm/direction_set.h"
#include "dlm/dlm_reader.h"
#include "dlm/probe_surface.h"

namespace lucarne {

/// Light from the cell of one ψ, above the horizon of the surface.
struct ProbeDirection {
  int psi = 0;
  Vec3d direction{};      // mean direction of the part of the cell above the horizon, toward the light, unit
  Rgbd irradiance{};      // lx
  double solidAngle = 0;  // of that part, sr
  double meanCosine = 0;  // of that part
};

struct ProbeAnswer {
  bool onSurface = false;  // false: nothing within a texel whose normal agrees; the rest is then empty
  std::uint32_t chart = kNone;
  bool back = false;
  Vec2d st{};                              // texel coordinates in the chart's rectangle
  Rgbd irradiance{};                       // lx, bilinear between texel centres, clamped to the chart's rectangle
  std::vector<ProbeDirection> directions;  // the members of the side, ψ ascending
  double standardError = 0;                // estimated, of the luminance of the irradiance; of the texel that holds the point
  double relativeError = 0;                // the same over the irradiance of that texel
  double photons = 0;                      // that fell into that texel
};

/// What of a ProbeDirection is asked for.
enum class ProbeDetail {
  all,
  irradiance,  // not direction, solid angle and mean cosine, which take most of the time
};

class Prober {
 public:
  /// `dlm` must outlive the prober.
  explicit Prober(const Dlm& dlm) : Prober(dlm.scene, dlm.maps) {}
  /// As read from a .dlm; both must outlive the prober. Without the texels of the directional maps in memory, light by
  /// direction is told as 0.
  Prober(const Scene& scene, const LightMaps& maps);

  /// Position in metres of the file's world; the normal need not be unit. InputError on a normal of length zero and on
  /// numbers that are not finite.
  ProbeAnswer probe(Vec3d position, Vec3d normal, ProbeDetail detail = ProbeDetail::all) const;

 private:
  void fillDirections(const SideMaps& side, const SurfacePoint& point, ProbeDetail detail, ProbeAnswer& answer) const;

  const LightMaps& maps_;
  DirectionSet directions_;
  SurfaceFinder surface_;
};

/// One line of `lucarne probe --json`; docs/dlm-format.md tells its members.
nlohmann::json toJson(const ProbeAnswer& answer);

}  // namespace lucarne
