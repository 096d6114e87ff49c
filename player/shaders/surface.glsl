
// What a fragment is: its chart side, its shading frame, its material, and the lobe that it looks along. The formulas are those
// of lobe.h.

in Vertex {
  vec3 fromEye;
  vec3 normal;
  vec4 uv;
  vec2 chartUv;
  flat uvec2 sides;
#ifdef RELIEF
  vec4 tangent;
#endif
#ifdef VIEW
  vec3 corner;  // barycentric coordinates
#endif
} v;

struct Side {  // gpu_records.h
  vec2 mapOrigin, size;
  vec2 irradianceOrigin;
  uint irradianceLayer, flags;
  uint firstLayer, stored, firstCell, members;
};
const uint kPresent = 1u, kLit = 2u, kDirections = 4u;

struct Material {
  vec4 baseColorMetallic, emissiveRoughness, specularColorFactor;
  // ((ior−1)/(ior+1))²; alpha, below 0: it does not count; cutoff of masks, below 0: only the front is there; scale of the
  // normal map.
  vec4 more;
  vec4 linear[4];   // texture transforms: rowU, rowV of base colour, metallic-roughness, emission, normal map
  vec4 offset[4];   // xy: offset, z: 1 for texture coordinate set 1, w of the first: transmission
};

layout(std430, binding = 0) readonly buffer SideBlock { Side sideRecords[]; };
layout(std430, binding = 1) readonly buffer MaterialBlock { Material materials[]; };

layout(binding = 3) uniform sampler2D specularTable;  // at x: cosθ, y: √α: scale, bias, mean of their sum over the hemisphere
#ifdef TEXTURED
layout(binding = 4) uniform sampler2D baseColorTexture;
layout(binding = 5) uniform sampler2D metallicRoughnessTexture;
layout(binding = 6) uniform sampler2D emissiveTexture;
#endif
#ifdef RELIEF
layout(binding = 10) uniform sampler2D normalTexture;
#endif
layout(binding = 8) uniform usampler2D ownerImage;

uniform int materialIndex;
uniform float cellSharpness;  // λ of a cell of Ω
uniform float meanBound;      // how many times as sharp as a cell its light may be shown
uniform float capCosine;      // of the radius of a cap as large as a cell

const float kPi = 3.14159265358979;
const float kMinAlpha = 1e-3;

// To be asked after the textures are read: pixels given up before would leave their neighbours without derivatives, and
// with a wrong mipmap along the borders of charts.
bool ownsPixel() { return texelFetch(ownerImage, ivec2(gl_FragCoord.xy), 0).r == v.sides.x; }

uint visibleRecord() { return gl_FrontFacing ? v.sides.x : v.sides.y; }
Side visibleSide() { return sideRecords[visibleRecord()]; }

#if defined(TEXTURED) || defined(RELIEF)
// Derivatives are taken of the attributes alone: a pixel beyond the edge of its triangle, there only for its neighbours'
// derivatives, may read zeros from buffers (llvmpipe), and what it makes of `m` is then wrong.
vec4 materialTexel(sampler2D image, Material m, int use) {
  bool second = m.offset[use].z > 0.5;
  vec4 dx = dFdx(v.uv), dy = dFdy(v.uv);
  vec2 uv = second ? v.uv.zw : v.uv.xy, ux = second ? dx.zw : dx.xy, uy = second ? dy.zw : dy.xy;
  mat2 linear = transpose(mat2(m.linear[use].xy, m.linear[use].zw));
  return textureGrad(image, linear * uv + m.offset[use].xy, linear * ux, linear * uy);
}
#endif

// Interpolated normal on the visible side: what the light of the maps was received with.
vec3 interpolatedNormal() { return normalize(gl_FrontFacing ? v.normal : -v.normal); }

// The normal that the eye sees. Tangent space is that of the front; the vector turns round with it on the back.
vec3 shadingNormal(Material m) {
  vec3 n = interpolatedNormal();
#ifdef RELIEF
  vec3 front = normalize(v.normal);
  vec3 tangent = v.tangent.xyz - front * dot(front, v.tangent.xyz);
  tangent = normalize(tangent);
  vec3 texel = materialTexel(normalTexture, m, 3).xyz * 2.0 - 1.0;
  texel.xy *= m.more.w;
  vec3 mapped = tangent * texel.x + cross(front, tangent) * (v.tangent.w < 0.0 ? -texel.y : texel.y) + front * texel.z;
  if (!(dot(mapped, mapped) > 0.0)) return n;
  mapped = normalize(gl_FrontFacing ? mapped : -mapped);
  float c = dot(mapped, n);
  return c >= 0.01 ? mapped : normalize(mapped + n * (0.01 - c));
#else
  return n;
#endif
}

// What a normal map makes of the light of a cell with mean direction `d`: received by it, over received by the normal of
// the maps. Grazing light is not made more than ten times as much.
float reliefWeight(vec3 n, vec3 mapped, vec3 d) {
#ifdef MEAN_CELLS
  d = normalize(d);
#endif
  return max(dot(mapped, d), 0.0) / max(dot(n, d), 0.1);
}

// Share of the pixel that the surface covers.
float coverage(Material m) {
  float alpha = m.more.y;
#ifdef TEXTURED
  alpha *= materialTexel(baseColorTexture, m, 0).a;
#endif
  if (m.more.y < 0.0) return 1.0;
  return m.more.z > 0.0 ? (alpha < m.more.z ? 0.0 : 1.0) : clamp(alpha, 0.0, 1.0);
}

float materialAlpha(Material m) {
  float roughness = m.emissiveRoughness.w;
#ifdef TEXTURED
  roughness *= materialTexel(metallicRoughnessTexture, m, 1).g;
#endif
  return max(roughness * roughness, kMinAlpha);
}

// The way the mirror of the shading normal sends the eye's ray; kept above the horizon.
vec3 mirrorDirection(vec3 n) {
  vec3 toEye = -normalize(v.fromEye);
  vec3 r = 2.0 * dot(n, toEye) * n - toEye;
  return normalize(r - n * min(dot(n, r), 0.0));
}

// What a cell's light counts in the highlight: `r` the mirror direction, `d` the mean direction of the cell, `n` the shading
// normal. lobeWidth() is what of it is the same for all cells.
#if defined(LOBE_BARSI) || defined(LOBE_SAMPLE)
float lobeWidth(float alpha) { return max(0.5 * (1.0 / (alpha * alpha) - 1.0), 0.0); }  // the Phong exponent

float lobeWeight(float exponent, vec3 r, vec3 d, vec3 n) {
#ifdef MEAN_CELLS
  d = normalize(d);
#endif
  float c = dot(r, d);
#ifdef LOBE_BARSI
  float across = sqrt(max((1.0 - c * c) * (1.0 - capCosine * capCosine), 0.0));
  float c1 = c >= capCosine ? 1.0 : c * capCosine + across;
  float c0 = c <= -capCosine ? -1.0 : c * capCosine - across;
  float density = (pow(max(c1, 0.0), exponent + 1.0) - pow(max(c0, 0.0), exponent + 1.0)) / (c1 - c0);
#else
  float density = (exponent + 1.0) * pow(max(c, 0.0), exponent);
#endif
  return density / (2.0 * kPi * max(dot(n, d), 0.02));
}
#elif defined(MEAN_LIGHT)
float lobeWidth(float alpha) { return 0.5 * (1.0 / (alpha * alpha) + 1.0); }

// g of lobe.h; `m`: a mean direction, of the cell's light or of constant light.
float lobeWeight(float lobe, vec3 r, vec3 m, vec3 n) {
  float square = dot(m, m), len = max(sqrt(square), 1e-4), inside = min(len, 1.0);
  float spread = (1.0 - min(square, 1.0)) / (inside * (3.0 - inside * inside));
  float sharpness = lobe / (1.0 + lobe * (1.0 / (meanBound * cellSharpness) + (1.0 - 1.0 / meanBound) * spread));
  return sharpness / (1.0 - exp(-2.0 * sharpness)) * exp(max(sharpness * (dot(r, m) / len - 1.0), -60.0));
}
#else
float lobeWidth(float alpha) {
  float lobe = 0.5 * (1.0 / (alpha * alpha) + 1.0);
  return lobe * cellSharpness / (lobe + cellSharpness);
}

float lobeWeight(float sharpness, vec3 r, vec3 d, vec3 n) { return exp(max(sharpness * (dot(r, d) - 1.0), -60.0)); }
#endif
