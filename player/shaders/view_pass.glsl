
// Views: what the light maps hold and how they lie, instead of what the eye would see. view_kind.h says what each is.
uniform ivec3 view;             // ViewKind, ψ, words a side
uniform float metresPerUnit;  // of local lengths

layout(location = 0) out vec4 color;

const int kIrradiance = 1, kDirection = 2, kPhotons = 3, kError = 4, kDensity = 5, kTexels = 6, kCharts = 7,
          kWireframe = 8, kAlbedo = 9;

// Texels go through a triangle evenly: the ratio of the areas that two neighbouring pixels span, in texels and on the
// surface, is that of the triangle.
float texelsPerMetre(Side side) {
  vec2 tx = dFdx(v.chartUv) * side.size, ty = dFdy(v.chartUv) * side.size;
  float texels = abs(tx.x * ty.y - tx.y * ty.x), area = length(cross(dFdx(v.fromEye), dFdy(v.fromEye)));
  return area > 0.0 ? sqrt(texels / area) / metresPerUnit : 0.0;
}

vec3 colourOf(uint id) {  // hues a golden ratio apart
  float hue = fract(float(id) * 0.61803399);
  vec3 rgb = clamp(abs(fract(hue + vec3(0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
  return mix(vec3(0.15), rgb, 0.4 + 0.3 * fract(float(id) * 0.75487767));
}

vec3 directionLight(Side side) {
  Member member = memberOf(visibleRecord(), view.y, view.z);
  return member.isStored ? storedLight(side, member.rank) * mapUnit * outputScale : vec3(0);
}

vec3 chequered(Side side) {
  ivec2 texel = ivec2(floor(clamp(v.chartUv, 0.0, 1.0) * side.size));
  return irradianceAt(side) * outputScale * (((texel.x + texel.y) & 1) == 0 ? 1.0 : 0.5);
}

vec3 wired(vec3 albedo) {
  vec3 near = smoothstep(vec3(0.5), vec3(1.5), v.corner / max(fwidth(v.corner), vec3(1e-20)));
  return mix(vec3(0.9, 0.95, 0.3), 0.35 * albedo, min(near.x, min(near.y, near.z)));
}

vec3 viewed(Side side, Material m) {
  vec3 albedo = m.baseColorMetallic.rgb;
#ifdef TEXTURED
  albedo *= materialTexel(baseColorTexture, m, 0).rgb;
#endif
  if (view.x == kWireframe) return wired(albedo);
  if (view.x == kAlbedo) return albedo;
  if (view.x == kCharts) return colourOf(v.sides.x);
  if (view.x > kAlbedo) return 0.5 * shadingNormal(m) + 0.5;
  float density = texelsPerMetre(side);
  if ((side.flags & kLit) == 0u) return vec3(0);
  if (view.x == kDensity) return vec3(density);
  if (view.x == kDirection) return (side.flags & kDirections) != 0u ? directionLight(side) : vec3(0);
  if (view.x == kTexels) return chequered(side);
  if (view.x == kIrradiance) return irradianceAt(side) * outputScale;
  vec2 statistics = statisticsAt(side);
  return vec3(view.x == kPhotons ? statistics.x : statistics.y);
}

void main() {
  color = vec4(viewed(visibleSide(), materials[materialIndex]), 1);
  if (!ownsPixel()) discard;
}
