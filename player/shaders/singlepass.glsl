
// Each fragment goes through its side's list; also what is composed over what lies behind it (CLEAR): blended surfaces and
// glass.
#ifdef CLEAR
layout(location = 0, index = 0) out vec4 color;
layout(location = 0, index = 1) out vec4 passed;  // share of what is behind
#else
layout(location = 0) out vec4 color;
#endif

// Stored maps come first in a side's list, in the order of their layers; then the empty ones, which only count as members.
void addLight(inout LightSums sums, vec4 light, vec3 d, float width, vec3 r, vec3 n, vec3 mapped) {
  sums.lobe += light * lobeWeight(width, r, d, mapped);
#ifdef RELIEF
  sums.relief += light * reliefWeight(n, mapped, d);
#endif
}

LightSums lightSums(Side side, Material m, vec3 mapped) {
  LightSums sums = LightSums(vec4(0), vec4(0));
#ifndef EVEN
  float width = lobeWidth(materialAlpha(m));
  vec3 n = interpolatedNormal(), r = mirrorDirection(mapped);
  vec2 node = octahedral(n);
  vec2 pageSize = vec2(textureSize(maps, 0).xy);
  vec2 texel = side.mapOrigin + texelPosition(side);
  uint stored = side.stored, perStrip = uint(layersPerStrip);
  for (uint start = 0u; start < stored; start += perStrip, texel.x += side.size.x) {
    uint count = min(perStrip, stored - start);
    vec2 page = texel / pageSize;
    for (uint k = 0u; k < count; ++k) {
      vec4 cell = cellAt(side.firstCell + start + k, node);
      vec3 light = mapValue(page, side.firstLayer + k);
#ifdef MEAN_LIGHT
      vec3 mean = meanValue(page, side.firstLayer + k, side.firstCell + start + k);
      addLight(sums, vec4(light, 0), mean, width, r, n, mapped);
      addLight(sums, vec4(0, 0, 0, cell.w), cell.xyz, width, r, n, mapped);
#else
      addLight(sums, vec4(light, cell.w), cell.xyz, width, r, n, mapped);
#endif
    }
  }
  for (uint k = stored; k < side.members; ++k) {
    vec4 cell = cellAt(side.firstCell + k, node);
    addLight(sums, vec4(0, 0, 0, cell.w), cell.xyz, width, r, n, mapped);
  }
#endif
  return sums;
}

void main() {
  Side side = visibleSide();
  Material m = materials[materialIndex];
  vec3 n = shadingNormal(m);
  vec3 radiance = outgoingRadiance(side, m, n, lightSums(side, m, n)) * outputScale;
#ifdef CLEAR
  vec3 behind = transmitted(m, n);
  float share = coverage(m);
  color = vec4(radiance * share, 1);
  passed = vec4(1.0 - share + share * behind, 1);
  if (m.more.z < 0.0 && !gl_FrontFacing) discard;
#else
  color = vec4(radiance, 1);
  if (!ownsPixel()) discard;
#endif
}
