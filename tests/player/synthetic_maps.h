// Scenes with light maps filled by formula: what a bake would give, known exactly.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "dlm/direction_set.h"
#include "dlm/light_maps.h"
#include "tests/support/scene_builder.h"

namespace lucarne::test {

struct BakedScene {
  Scene scene;
  LightMaps maps;
};

/// What one side of a chart gets.
struct SideSpec {
  bool lit = true;
  bool directions = true;  // false: irradiance only
  int dropEvery = 0;       // k > 0: every k-th member's map is empty
};

/// Radiance that reaches a point (metres) from the cell around `direction`.
using IncidentRadiance = std::function<Rgb(Vec3d point, Vec3d direction)>;

class BakedSceneBuilder {
 public:
  BakedSceneBuilder(int directionCount, IncidentRadiance radiance);

  std::uint32_t addMaterial(Material material) { return builder_.addMaterial(std::move(material)); }
  /// a b c d counter-clockwise from the front; texels along ab and ad. Without `back`, the back absorbs.
  void addQuad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, std::uint32_t material, int width, int height, SideSpec front = {},
               std::optional<SideSpec> back = std::nullopt);
  /// Six smooth charts (a cube blown up), `cells`² quads and `texels`² texels each.
  void addSphere(Vec3d center, double radius, std::uint32_t material, int cells, int texels, SideSpec front = {});
  void addCamera(Vec3d eye, Vec3d target, double yfov = 0.8) { builder_.addCamera(eye, target, yfov); }

  /// Maps get mean directions, too: those of light that fills each cell evenly.
  void withMeans() { means_ = true; }
  BakedScene build();

  const DirectionSet& directions() const { return set_; }

 private:
  struct ChartPlan {
    MapChart chart;
    SideSpec front;
    std::optional<SideSpec> back;
    std::vector<Vec3d> normals;   // of the texels' centres, row by row; one for flat charts
    std::vector<Vec3d> points;    // of the texels' centres, metres
    std::vector<Vec3d> horizons;  // normals that decide which directions are members
  };
  void addPatch(Vec3d center, double radius, int face, std::uint32_t material, int cells, int texels, SideSpec front);
  void addSide(LightMaps& maps, const ChartPlan& plan, std::uint32_t chart, bool back);

  DirectionSet set_;
  bool means_ = false;
  IncidentRadiance radiance_;
  SceneBuilder builder_;
  std::vector<ChartPlan> plans_;
  std::vector<std::uint32_t> chartOfTriangle_;
  struct Corner {
    std::uint32_t chart;
    Vec2d st;                     // texel coordinates
    std::optional<Vec3d> normal;  // of smooth charts
  };
  std::vector<Corner> corners_;  // a vertex
};

/// Radiance `L` from everywhere.
IncidentRadiance constantRadiance(Rgb L);

/// A furnished room for the comparison of renderers, with every kind of side: flat, smooth, two-sided, with empty maps,
/// with irradiance alone, unlit, textured.
BakedScene furnishedRoom(int directionCount, bool means = false);

}  // namespace lucarne::test
