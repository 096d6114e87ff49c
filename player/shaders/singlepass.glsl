
layout(location = 0) out vec4 color;

// Stored maps come first in a side's list, in the order of their layers; then the empty ones, which only count as members.
vec4 lobeSums(Side side, Material m, vec3 n) {
  float width = lobeWidth(materialAlpha(m));
  vec3 r = mirrorDirection(n);
  vec2 node = octahedral(n);
  vec2 pageSize = vec2(textureSize(maps, 0).xy);
  vec2 texel = side.mapOrigin + texelPosition(side);
  uint stored = side.stored, perStrip = uint(layersPerStrip);
  vec4 sum = vec4(0);
  for (uint start = 0u; start < stored; start += perStrip, texel.x += side.size.x) {
    uint count = min(perStrip, stored - start);
    vec2 page = texel / pageSize;
    for (uint k = 0u; k < count; ++k) {
      vec4 cell = cellAt(side.firstCell + start + k, node);
      sum += vec4(mapValue(page, side.firstLayer + k), cell.w) * lobeWeight(width, r, cell.xyz, n);
    }
  }
  for (uint k = stored; k < side.members; ++k) {
    vec4 cell = cellAt(side.firstCell + k, node);
    sum.a += cell.w * lobeWeight(width, r, cell.xyz, n);
  }
  return sum;
}

void main() {
  Side side = visibleSide();
  Material m = materials[materialIndex];
  vec3 n = shadingNormal();
  color = vec4(outgoingRadiance(side, m, n, lobeSums(side, m, n)) * outputScale, 1);
  if (!ownsPixel()) discard;
}
