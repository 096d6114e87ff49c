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
};

/// Charts that are drawn with one shader variant and one material.
struct Batch {
  ShaderVariant variant;
  std::uint32_t material = 0;
  std::uint32_t firstVertex = 0, vertexCount = 0;
  std::uint32_t firstRun = 0, runCount = 0;
};

struct DrawList {
  std::vector<GpuVertex> vertices;
  std::vector<ChartRun> runs;
  std::vector<Batch> batches;
};

/// Sorted by variant, then material, then chart. Triangles without a chart (degenerate ones) are not drawn. Needs
/// scene.chartOfTriangle and scene.uv1 as places in the irradiance atlas; InputError without them.
DrawList buildDrawList(const Scene& scene, const LightMaps& maps);

/// True for materials with any texture.
bool isTextured(const Material& material);

GpuMaterial gpuMaterial(const Material& material);

}  // namespace lucarne
