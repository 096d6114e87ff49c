
// The light maps of a side and the cells that they are of: vec4(mean direction, cosine integral), both clipped by the horizon.
// MEAN_CELLS: the direction is that of constant light and its length says how far it spreads (m̄ of lobe.h).
// Planar charts have their own list. Others (CURVED) look it up by the shading normal: octahedral layers, one a ψ, values at
// the texel centres so that the axes are exact; the list then holds ψ.

layout(binding = 0) uniform sampler2DArray maps;
layout(std430, binding = 2) readonly buffer CellBlock { vec4 cells[]; };
uniform int layersPerStrip;  // a side with more directions than layers goes on to the right of itself

#ifdef CURVED
layout(binding = 2) uniform sampler2DArray cellTable;
uniform ivec2 cellTableShape;  // nodes along an edge; layers

vec2 octahedral(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return (p * 0.5 + 0.5) * float(cellTableShape.x - 1) + 0.5;  // in texels of one tile
}
vec4 cellAt(uint index, vec2 node) {
  int psi = int(cells[index].w);
  int tile = psi / cellTableShape.y;
  vec2 size = vec2(textureSize(cellTable, 0).xy);
  return textureLod(cellTable, vec3((node + vec2(tile * cellTableShape.x, 0)) / size, psi - tile * cellTableShape.y), 0.0);
}
#else
vec2 octahedral(vec3 n) { return vec2(0); }
vec4 cellAt(uint index, vec2 node) { return cells[index]; }
#endif

// Texel position inside the rectangle, clamped to its texel centres: pages are powers of two, so no neighbour leaks in.
vec2 texelPosition(Side side) { return clamp(v.chartUv * side.size, vec2(0.5), side.size - 0.5); }

#ifdef MEAN_LIGHT
layout(binding = 12) uniform sampler2DArray meanMaps;  // at the places of `maps`: (m − ψ)/meanReach, −1 … 1 as 0 … 1
layout(std430, binding = 4) readonly buffer DirectionBlock { vec4 directions[]; };  // ψ of each of `cells`
uniform float meanReach;

vec3 meanValue(vec2 page, uint layer, uint cell) {
  vec3 code = textureLod(meanMaps, vec3(page, float(layer)), 0.0).xyz;
  return directions[cell].xyz + meanReach * (code * 2.0 - 1.0);
}
#endif

vec3 mapValue(vec2 page, uint layer) { return textureLod(maps, vec3(page, float(layer)), 0.0).rgb; }
