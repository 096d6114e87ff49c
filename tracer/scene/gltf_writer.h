// Writes a scene as GLB with its triangles placed in an irradiance atlas: what a .dlm folder holds as scene.glb.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// Place of every triangle in the atlas.
struct AtlasUv {
  std::vector<std::array<Vec2f, 3>> corner;    // per triangle, 0..1 in the atlas, corners in the order of Triangle::v
  std::vector<std::uint32_t> chartOfTriangle;  // kNone for triangles without a chart; below 2^24
};

/// The scene's own document with everything in it kept (extras, animations, unknown extensions, images, which move into
/// the one binary chunk). Every triangle primitive of the scene gets TEXCOORD_1, the place in the atlas, and the
/// attribute _CHART, the chart's number or −1; vertices whose corners differ in them are split, with all their
/// attributes. Where a material uses TEXCOORD_1, that set moves to the first free one, and the material with it. Strips
/// and fans become triangles, and meshes that several nodes share are written once a node. Triangle i stays triangle i:
/// reading it again gives the same bits of positions, normals and materials.
///
/// A scene without source is written from its plain data; its positions pass through metres and may come back with
/// another last bit.
std::vector<std::uint8_t> writeSceneGlb(const Scene& scene, const AtlasUv& uv);

}  // namespace lucarne
