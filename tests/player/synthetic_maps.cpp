#include "tests/player/synthetic_maps.h"

#include "player/cell_tables.h"

namespace lucarne::test {
namespace {

/// Point of the unit sphere over (s, t) in [0, 1]² of one face of the cube; counter-clockwise in (s, t) seen from
/// outside.
Vec3d spherePoint(int face, double s, double t) {
  const double a = 2 * s - 1, b = 2 * t - 1;
  const Vec3d cube[6] = {{1, a, b}, {-1, b, a}, {b, 1, a}, {a, -1, b}, {a, b, 1}, {b, a, -1}};
  return normalize(cube[face]);
}

}  // namespace

BakedSceneBuilder::BakedSceneBuilder(int directionCount, IncidentRadiance radiance)
    : set_(directionCount), radiance_(std::move(radiance)) {}

void BakedSceneBuilder::addQuad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, std::uint32_t material, int width, int height,
                                SideSpec front, std::optional<SideSpec> back) {
  ChartPlan plan;
  plan.chart.material = material;
  plan.chart.normal = Vec3f(normalize(cross(b - a, d - a)));
  plan.chart.width = width;
  plan.chart.height = height;
  plan.front = front;
  plan.back = back;
  plan.normals = plan.horizons = {Vec3d(plan.chart.normal)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      plan.points.push_back(a + (b - a) * ((x + 0.5) / width) + (d - a) * ((y + 0.5) / height));
  }
  const auto chart = static_cast<std::uint32_t>(plans_.size());
  plans_.push_back(std::move(plan));
  builder_.addQuad(a, b, c, d, material);
  chartOfTriangle_.insert(chartOfTriangle_.end(), 2, chart);
  const double w = width, h = height;
  for (const Vec2d st : {Vec2d{0, 0}, Vec2d{w, 0}, Vec2d{w, h}, Vec2d{0, h}})
    corners_.push_back({chart, st, std::nullopt});
}

void BakedSceneBuilder::addSphere(Vec3d center, double radius, std::uint32_t material, int cells, int texels,
                                  SideSpec front) {
  for (int face = 0; face < 6; ++face) addPatch(center, radius, face, material, cells, texels, front);
}

void BakedSceneBuilder::addPatch(Vec3d center, double radius, int face, std::uint32_t material, int cells, int texels,
                                 SideSpec front) {
  ChartPlan plan;
  plan.chart.material = material;
  plan.chart.normal = Vec3f(spherePoint(face, 0.5, 0.5));
  plan.chart.width = plan.chart.height = texels;
  plan.chart.smooth = true;
  plan.chart.planar = false;
  plan.front = front;
  for (int y = 0; y < texels; ++y) {
    for (int x = 0; x < texels; ++x) {
      plan.normals.push_back(spherePoint(face, (x + 0.5) / texels, (y + 0.5) / texels));
      plan.points.push_back(center + plan.normals.back() * radius);
    }
  }
  const auto chart = static_cast<std::uint32_t>(plans_.size());
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const Vec2d st[4] = {{x + 0., y + 0.}, {x + 1., y + 0.}, {x + 1., y + 1.}, {x + 0., y + 1.}};
      Vec3d n[4];
      for (int k = 0; k < 4; ++k) {
        n[k] = spherePoint(face, st[k].x / cells, st[k].y / cells);
        plan.horizons.push_back(n[k]);
        corners_.push_back({chart, st[k] * (static_cast<double>(texels) / cells), n[k]});
      }
      builder_.addQuad(center + n[0] * radius, center + n[1] * radius, center + n[2] * radius, center + n[3] * radius,
                       material);
      chartOfTriangle_.insert(chartOfTriangle_.end(), 2, chart);
    }
  }
  plans_.push_back(std::move(plan));
}

void BakedSceneBuilder::addSide(LightMaps& maps, const ChartPlan& plan, std::uint32_t chart, bool back) {
  const SideSpec& spec = back ? *plan.back : plan.front;
  MapChart& mapChart = maps.charts[chart];
  (back ? mapChart.backSide : mapChart.frontSide) = static_cast<std::uint32_t>(maps.sides.size());
  SideMaps side{chart, back, spec.lit, plan.chart.width, plan.chart.height, maps.irradiance.size(), {}};
  const double sign = back ? -1 : 1;
  if (spec.lit) {
    const std::size_t texels = plan.points.size();
    std::vector<Rgb> E(texels);
    int rank = 0;
    for (int psi = 0; psi < set_.count(); ++psi) {
      bool member = false;
      for (const Vec3d& n : plan.horizons) member = member || set_.reaches(psi, n * sign);
      if (!member) continue;
      ++rank;
      const bool empty = spec.dropEvery > 0 && rank % spec.dropEvery == 0;
      SideDirection direction{static_cast<std::uint16_t>(psi), SideDirection::kEmptyMap};
      if (spec.directions && !empty) direction.first = maps.directional.size();
      for (std::size_t i = 0; i < texels && !empty; ++i) {
        const Vec3d n = plan.normals[plan.normals.size() == 1 ? 0 : i] * sign;
        const auto C = static_cast<float>(set_.clippedCell(psi, n).cosIntegral);
        const Rgb B = radiance_(plan.points[i], set_.direction(psi)) * C;
        E[i] += B;
        if (!spec.directions) continue;
        maps.directional.push_back(B);
        if (means_) maps.meanDirections.push_back(meanCell(set_, psi, n).direction);
      }
      if (spec.directions) side.directions.push_back(direction);
    }
    maps.irradiance.insert(maps.irradiance.end(), E.begin(), E.end());
    maps.relativeError.resize(maps.irradiance.size());
    maps.standardError.resize(maps.irradiance.size());
    maps.photons.resize(maps.irradiance.size());
  }
  maps.sides.push_back(std::move(side));
}

BakedScene BakedSceneBuilder::build() {
  BakedScene baked{builder_.build(), {}};
  LightMaps& maps = baked.maps;
  maps.directionCount = set_.count();
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    maps.charts.push_back(plans_[i].chart);
    maps.charts[i].atlasX = 1;
    maps.charts[i].atlasY = maps.atlasHeight + 1;
    maps.atlasHeight += plans_[i].chart.height + 2;
    maps.atlasWidth = std::max(maps.atlasWidth, plans_[i].chart.width + 2);
    addSide(maps, plans_[i], static_cast<std::uint32_t>(i), false);
    if (plans_[i].back) addSide(maps, plans_[i], static_cast<std::uint32_t>(i), true);
  }
  Scene& scene = baked.scene;
  scene.chartOfTriangle = chartOfTriangle_;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const MapChart& chart = maps.charts[corners_[i].chart];
    scene.atlasUv.push_back({static_cast<float>((chart.atlasX + corners_[i].st.x) / maps.atlasWidth),
                             static_cast<float>((chart.atlasY + corners_[i].st.y) / maps.atlasHeight)});
    if (corners_[i].normal) scene.normals[i] = Vec3f(*corners_[i].normal);
  }
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    scene.smooth[t] = maps.charts[chartOfTriangle_[t]].smooth ? 1 : 0;
  return baked;
}

IncidentRadiance constantRadiance(Rgb L) {
  return [L](Vec3d, Vec3d) { return L; };
}

namespace {

/// A lamp near the ceiling, a window at −x, bounce light that is a little red on the right.
Rgb roomLight(Vec3d p, Vec3d direction) {
  const Vec3d toLamp = Vec3d{0, 2.6, 0} - p, toWindow = Vec3d{-2.5, 1.4, 0.5} - p;
  const auto glow = [&](Vec3d to, double width) {
    return std::exp(-(1 - dot(normalize(to), direction)) / width) / (1 + dot(to, to));
  };
  const Rgb bounce = Rgb{6.f, 5.f, 4.f} * (direction.x > 0 ? 1.2f : 0.8f);
  return bounce + Rgb{400.f, 340.f, 260.f} * static_cast<float>(glow(toLamp, 0.06)) +
         Rgb{90.f, 120.f, 200.f} * static_cast<float>(glow(toWindow, 0.15));
}

Material glossy(Rgb color, float metallic, float roughness) {
  Material m;
  m.baseColor = color;
  m.metallic = metallic;
  m.roughness = roughness;
  return m;
}

}  // namespace

BakedScene furnishedRoom(int directionCount, bool means) {
  BakedSceneBuilder b(directionCount, roomLight);
  if (means) b.withMeans();
  const std::uint32_t wall = b.addMaterial(diffuseMaterial({0.7f, 0.7f, 0.65f}));
  const std::uint32_t floor = b.addMaterial(glossy({0.5f, 0.35f, 0.2f}, 0, 0.45f));
  const std::uint32_t metal = b.addMaterial(glossy({0.9f, 0.75f, 0.4f}, 1, 0.35f));
  const std::uint32_t plastic = b.addMaterial(glossy({0.1f, 0.2f, 0.6f}, 0, 0.6f));
  Material table = glossy({0.6f, 0.2f, 0.15f}, 0.3f, 0.5f);
  table.doubleSided = true;
  const std::uint32_t top = b.addMaterial(table);
  const std::uint32_t lamp = b.addMaterial(diffuseMaterial({0.8f, 0.8f, 0.8f}, {3000.f, 2700.f, 2200.f}));
  const SideSpec irradianceOnly{true, false, 0}, unlit{false, true, 0}, thinned{true, true, 3};

  b.addQuad({-2.5, 0, 2}, {2.5, 0, 2}, {2.5, 0, -2}, {-2.5, 0, -2}, floor, 40, 32);                         // floor
  b.addQuad({-2.5, 2.8, -2}, {2.5, 2.8, -2}, {2.5, 2.8, 2}, {-2.5, 2.8, 2}, wall, 20, 16, irradianceOnly);  // ceiling
  b.addQuad({-2.5, 0, -2}, {2.5, 0, -2}, {2.5, 2.8, -2}, {-2.5, 2.8, -2}, wall, 20, 11, irradianceOnly);    // −z
  b.addQuad({2.5, 0, 2}, {-2.5, 0, 2}, {-2.5, 2.8, 2}, {2.5, 2.8, 2}, plastic, 20, 11, thinned);            // +z
  b.addQuad({-2.5, 0, 2}, {-2.5, 0, -2}, {-2.5, 2.8, -2}, {-2.5, 2.8, 2}, plastic, 16, 11);                 // −x
  b.addQuad({2.5, 0, -2}, {2.5, 0, 2}, {2.5, 2.8, 2}, {2.5, 2.8, -2}, wall, 16, 11, irradianceOnly);        // +x
  b.addQuad({0.2, 0.8, 0.5}, {1.6, 0.8, 0.5}, {1.6, 0.8, -0.6}, {0.2, 0.8, -0.6}, top, 14, 11, thinned, SideSpec{});
  b.addQuad({-0.3, 2.7, -0.3}, {0.3, 2.7, -0.3}, {0.3, 2.7, 0.3}, {-0.3, 2.7, 0.3}, lamp, 6, 6, irradianceOnly);
  b.addQuad({1.9, 0.01, -1}, {2.4, 0.01, -1}, {2.4, 0.6, -1.9}, {1.9, 0.6, -1.9}, plastic, 4, 4, unlit, SideSpec{});
  b.addSphere({-1, 0.6, -0.5}, 0.6, metal, 8, 12, thinned);
  b.addSphere({0.9, 1.05, 0}, 0.25, plastic, 6, 8);
  b.addCamera({-1.8, 1.5, 1.7}, {0.6, 0.7, -0.7}, 1.0);
  return b.build();
}

}  // namespace lucarne::test
