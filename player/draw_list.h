// The scene's triangles in drawing order, still in memory: corners expanded, sorted by what a state change would cost.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/light_maps.h"
#include "player/gpu_records.h"
#include "player/programs.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The triangles of one chart.
struct ChartRun {
  std::uint32_t chart;
  std::uint32_t firstVertex, vertexCount;
  Vec3f lower, upper;  // bounds, local
};

/// Charts that are drawn with one shader variant and one material.
struct Batch {
  ShaderVariant variant;
  std::uint32_t material = 0;
  std::uint32_t firstRun = 0, runCount = 0;
  std::uint32_t endRun() const { return firstRun + runCount; }
};

/// A triangle that is composed over what is behind it.
struct ClearTriangle {
  Vec3f centre;  // local
  std::uint32_t batch, run, firstVertex;
};

struct DrawList {
  std::vector<GpuVertex> vertices;
  std::vector<ChartRun> runs;
  std::vector<Batch> batches;  // those of clear ones last
  std::vector<ClearTriangle> clear;
};

/// Sorted by variant, then material, then chart. Triangles without a chart (degenerate ones) are not drawn. Needs
/// scene.chartOfTriangle and scene.uv1 as places in the irradiance atlas; InputError without them.
DrawList buildDrawList(const Scene& scene, const LightMaps& maps);

/// What the shaders must do for a chart of a material.
ShaderVariant variantOf(const Scene& scene, const LightMaps& maps, const MapChart& chart, const Material& material);

/// True for materials with any texture but a normal map.
bool isTextured(const Material& material);

GpuMaterial gpuMaterial(const Material& material);

}  // namespace lucarne
