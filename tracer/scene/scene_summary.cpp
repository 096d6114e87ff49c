#include "tracer/scene/scene_summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lucarne {
namespace {

using Json = nlohmann::json;

template <class T>
Json triple(Vec3<T> v) {
  return Json::array({v.x, v.y, v.z});
}

template <class Has>
std::size_t countTriangles(const Scene& scene, const Has& has) {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) count += has(t) ? 1 : 0;
  return count;
}

Json emissiveMaterials(const Scene& scene) {
  Json list = Json::array();
  for (const Material& m : scene.materials) {
    if (m.emits()) list.push_back({{"name", m.name}, {"emissive_cd_per_m2", triple(m.emissive)}});
  }
  return list;
}

Json lightsOf(const Scene& scene) {
  constexpr const char* kinds[] = {"point", "spot", "directional"};
  Json list = Json::array();
  for (const Light& light : scene.lights) {
    list.push_back({{"name", light.name},
                    {"kind", kinds[static_cast<int>(light.kind)]},
                    {"intensity", triple(light.intensity)},
                    {"unit", light.kind == LightKind::directional ? "lx" : "cd"}});
  }
  return list;
}

Json camerasOf(const Scene& scene) {
  Json list = Json::array();
  for (const Camera& c : scene.cameras) {
    list.push_back({{"name", c.name}, {"position_m", triple(scene.frame.toWorld(c.position))}, {"yfov", c.yfov}});
  }
  return list;
}

/// Of the corners of triangles; null for a scene without any.
Json boundsOf(const Scene& scene) {
  Box box;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) box.add(scene.frame.toWorld(Vec3d(scene.corner(t, k))));
  }
  if (box.empty()) return nullptr;
  return {{"min", triple(box.lo)}, {"max", triple(box.hi)}, {"size", triple(box.extent())}};
}

std::uint32_t chartCount(const Scene& scene) {
  std::uint32_t count = 0;
  for (const std::uint32_t chart : scene.chartOfTriangle) {
    if (chart != kNone) count = std::max(count, chart + 1);
  }
  return count;
}

}  // namespace

Json summarize(const Scene& scene) {
  const auto material = [&](std::uint32_t t) -> const Material& {
    return scene.materials[scene.triangles[t].material];
  };
  const auto doubleSided = [](const Material& m) { return m.doubleSided; };
  Json json;
  json["triangles"] = scene.triangles.size();
  json["degenerate_triangles"] = scene.degenerateTriangles;
  json["duplicate_triangles"] = scene.duplicateTriangles;
  json["smooth_triangles"] = countTriangles(scene, [&](auto t) { return scene.smooth[t] != 0; });
  json["double_sided_triangles"] = countTriangles(scene, [&](auto t) { return material(t).doubleSided; });
  json["emissive_triangles"] = countTriangles(scene, [&](auto t) { return material(t).emits(); });
  json["vertices"] = scene.positions.size();
  json["primitives"] = scene.instances.size();
  json["materials"] = scene.materials.size();
  json["double_sided_materials"] = std::count_if(scene.materials.begin(), scene.materials.end(), doubleSided);
  json["emissive_materials"] = emissiveMaterials(scene);
  json["textures"] = scene.textures.size();
  json["images"] = scene.images.size();
  json["lights"] = lightsOf(scene);
  json["cameras"] = camerasOf(scene);
  json["bounds_m"] = boundsOf(scene);
  json["charts"] = chartCount(scene);
  json["left_out"] = scene.leftOut;
  return json;
}

}  // namespace lucarne
