#include "player/draw_list.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/error.h"
#include "player/map_tables.h"
#include "tracer/optics/surface.h"

namespace lucarne {
namespace {

void checkCharts(const Scene& scene, const LightMaps& maps) {
  if (scene.chartOfTriangle.size() != scene.triangles.size() || scene.atlasUv.size() != scene.positions.size()) {
    throw InputError("the scene does not name the chart of each triangle; bake it again");
  }
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (scene.chartOfTriangle[i] == kNone) continue;
    LUCARNE_CHECK_LT(scene.chartOfTriangle[i], maps.charts.size());
    LUCARNE_CHECK_LT(scene.triangles[i].material, scene.materials.size());
  }
}

/// The record of a side (gpu_records.h).
std::uint32_t recordOf(std::uint32_t side) { return side == kNone ? 0 : side + 1; }

/// Place in the chart's rectangle, 0..1, from the place in the atlas.
Vec2f chartUv(const LightMaps& maps, const MapChart& chart, Vec2f atlasUv) {
  const double s = static_cast<double>(atlasUv.x) * maps.atlasWidth - chart.atlasX;
  const double t = static_cast<double>(atlasUv.y) * maps.atlasHeight - chart.atlasY;
  return {static_cast<float>(s / std::max(chart.width, 1)), static_cast<float>(t / std::max(chart.height, 1))};
}

GpuVertex corner(const Scene& scene, const LightMaps& maps, std::uint32_t triangle, int k) {
  const MapChart& chart = maps.charts[scene.chartOfTriangle[triangle]];
  const std::uint32_t i = scene.triangles[triangle].v[k];
  const Vec3f p = scene.positions[i];
  const bool smooth = triangle < scene.smooth.size() && scene.smooth[triangle] != 0;
  const Vec3f n = smooth ? scene.normals[i] : Vec3f(normalize(scene.scaledNormal(triangle)));
  const Vec2f uv0 = scene.uv0.empty() ? Vec2f{} : scene.uv0[i], uv1 = scene.uv1.empty() ? Vec2f{} : scene.uv1[i];
  const Vec2f c = chartUv(maps, chart, scene.atlasUv[i]);
  const Vec4f t = scene.tangents.empty() ? Vec4f{} : scene.tangents[i];
  return {{p.x, p.y, p.z}, {n.x, n.y, n.z},           {uv0.x, uv0.y},           {uv1.x, uv1.y},
          {c.x, c.y},      recordOf(chart.frontSide), recordOf(chart.backSide), {t.x, t.y, t.z, t.w}};
}

bool hasDirections(const LightMaps& maps, const MapChart& chart) {
  const auto has = [&](std::uint32_t side) {
    return side != kNone && maps.sides[side].lit && !maps.sides[side].directions.empty();
  };
  return has(chart.frontSide) || has(chart.backSide);
}

/// Alpha and cutoff of GpuMaterial.
void setAlpha(const Material& m, GpuMaterial& g) {
  g.alpha = m.hasAlpha() ? m.alpha : -1.f;
  if (m.hasAlpha() && m.alphaMode == AlphaMode::mask) g.alphaCutoff = std::max(m.alphaCutoff, 1e-6f);
  if (m.unlit && !m.doubleSided) g.alphaCutoff = -1.f;  // as coverageOf() of tracer/optics
}

/// Adds a triangle's corners to the last run.
void addTriangle(const Scene& scene, const LightMaps& maps, std::uint32_t triangle, DrawList& list) {
  ChartRun& run = list.runs.back();
  const auto vertex = static_cast<std::uint32_t>(list.vertices.size());
  Vec3f centre{};
  for (int k = 0; k < 3; ++k) {
    list.vertices.push_back(corner(scene, maps, triangle, k));
    const Vec3f p = scene.corner(triangle, k);
    centre += p * (1.f / 3.f);
    for (int i = 0; i < 3; ++i) {
      run.lower[i] = run.vertexCount + k == 0 ? p[i] : std::min(run.lower[i], p[i]);
      run.upper[i] = run.vertexCount + k == 0 ? p[i] : std::max(run.upper[i], p[i]);
    }
  }
  run.vertexCount += 3;
  const auto batch = static_cast<std::uint32_t>(list.batches.size() - 1),
             last = static_cast<std::uint32_t>(list.runs.size() - 1);
  if (list.batches.back().variant.clear) list.clear.push_back({centre, batch, last, vertex});
}

}  // namespace

bool isTextured(const Material& m) {
  return bool(m.baseColorTexture) || bool(m.metallicRoughnessTexture) || (m.emits() && bool(m.emissiveTexture));
}

GpuMaterial gpuMaterial(const Material& m) {
  const auto unit = [](float v) { return std::clamp(v, 0.f, 1.f); };
  const float r = (m.ior - 1) / (m.ior + 1);
  GpuMaterial g{{unit(m.baseColor.x), unit(m.baseColor.y), unit(m.baseColor.z)},
                unit(m.metallic),
                {m.emissive.x, m.emissive.y, m.emissive.z},
                unit(m.roughness),
                {m.specularColor.x, m.specularColor.y, m.specularColor.z},
                unit(m.specular),
                r * r,
                -1.f,
                0.f,
                m.normalScale,
                {},
                {}};
  setAlpha(m, g);
  const TextureUse* uses[4] = {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture, &m.normalTexture};
  for (int k = 0; k < 4; ++k) {
    const TextureUse& use = *uses[k];
    const float linear[4] = {use.rowU.x, use.rowU.y, use.rowV.x, use.rowV.y};
    const float offset[4] = {use.offset.x, use.offset.y, use.uvSet == 1 ? 1.f : 0.f, 0.f};
    std::copy_n(linear, 4, g.linear[k]);
    std::copy_n(offset, 4, g.offset[k]);
  }
  g.offset[0][3] = m.transmits() ? unit(m.transmission) : 0.f;
  return g;
}

ShaderVariant variantOf(const Scene& scene, const LightMaps& maps, const MapChart& chart, const Material& m) {
  ShaderVariant v;
  v.clear = m.transmits() || (m.hasAlpha() && m.alphaMode == AlphaMode::blend);
  v.masked = !v.clear && (m.hasAlpha() || (m.unlit && !m.doubleSided));
  v.curved = needsCellTable(chart);
  v.textured = isTextured(m);
  v.relief = m.normalTexture && !m.unlit && !scene.tangents.empty();
  v.even = !hasDirections(maps, chart);
  v.lambert = makeBsdf(m, factorsOf(m)).lambert();  // textures only take from the coat
  return v;
}

DrawList buildDrawList(const Scene& scene, const LightMaps& maps) {
  checkCharts(scene, maps);
  const auto keyOf = [&](std::uint32_t triangle) {
    const std::uint32_t chart = scene.chartOfTriangle[triangle], material = scene.triangles[triangle].material;
    return std::tuple(variantOf(scene, maps, maps.charts[chart], scene.materials[material]), material, chart);
  };
  using Key = std::tuple<ShaderVariant, std::uint32_t, std::uint32_t>;
  std::vector<std::pair<Key, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    if (scene.chartOfTriangle[i] != kNone) order.emplace_back(keyOf(i), i);
  }
  std::sort(order.begin(), order.end());

  DrawList list;
  list.vertices.reserve(order.size() * 3);
  for (const auto& [key, triangle] : order) {
    const auto& [variant, material, chart] = key;
    if (list.batches.empty() ||
        std::tie(list.batches.back().variant, list.batches.back().material) != std::tie(variant, material))
      list.batches.push_back({variant, material, static_cast<std::uint32_t>(list.runs.size()), 0});
    Batch& batch = list.batches.back();
    if (batch.runCount == 0 || list.runs.back().chart != chart) {
      list.runs.push_back({chart, static_cast<std::uint32_t>(list.vertices.size()), 0, {}, {}});
      ++batch.runCount;
    }
    addTriangle(scene, maps, triangle, list);
  }
  return list;
}

}  // namespace lucarne
