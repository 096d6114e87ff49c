// Records that shaders read, in the layout of std430; twins of the structs in shaders/surface.glsl and
// direction_pass.glsl.
#pragma once

#include <cstdint>

namespace lucarne {

/// One chart side. Record 0 is the side that absorbs unseen; side i of LightMaps is record i + 1.
struct GpuSide {
  static constexpr std::uint32_t kPresent = 1, kLit = 2, kDirections = 4;

  float mapX = 0, mapY = 0;  // first texel of its rectangle in the directional pages
  float width = 0, height = 0;
  float irradianceX = 0, irradianceY = 0;
  std::uint32_t irradianceLayer = 0;
  std::uint32_t flags = 0;
  std::uint32_t firstLayer = 0;  // of its stored directions, in consecutive layers
  std::uint32_t stored = 0;
  std::uint32_t firstCell = 0;  // into the list of cells: stored members, then empty ones, each by ascending ψ
  std::uint32_t members = 0;
};
static_assert(sizeof(GpuSide) == 48);

/// Of 32 consecutive ψ: which are members of a side, and how many members lie before these 32.
struct GpuMemberBits {
  std::uint32_t stored = 0, storedBefore = 0, empty = 0, emptyBefore = 0;
};
static_assert(sizeof(GpuMemberBits) == 16);

struct GpuMaterial {
  float baseColor[3], metallic;
  float emissive[3], roughness;
  float specularColor[3], specular;
  float dielectric;   // ((ior − 1)/(ior + 1))²
  float alpha;        // −1 where the surface covers all
  float alphaCutoff;  // of masks; 0: not a mask; −1: only the front is there
  float normalScale;
  float linear[4][4];  // of base colour, metallic-roughness, emission, normal map: rowU, rowV
  float offset[4][4];  // offset, texture coordinate set; the first one's last is the transmission
};
static_assert(sizeof(GpuMaterial) == 192);

/// A corner of a triangle.
struct GpuVertex {
  float position[3];
  float normal[3];  // shading normal of the front
  float uv0[2], uv1[2];
  float chartUv[2];                   // 0..1 over the chart's rectangle
  std::uint32_t frontSide, backSide;  // records
  float tangent[4];                   // of the normal map: unit, sign of the bitangent
};
static_assert(sizeof(GpuVertex) == 72);

}  // namespace lucarne
