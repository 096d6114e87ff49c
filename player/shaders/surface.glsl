
// What a fragment is: its chart side, its shading frame, its material, and the lobe that it looks along. The formulas are those
// of lobe.h.

in Vertex {
  vec3 fromEye;
  vec3 normal;
  vec4 uv;
  vec2 chartUv;
  flat uvec2 sides;
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
  vec4 dielectric;  // x: ((ior−1)/(ior+1))²
  vec4 linear[3];   // texture transforms: rowU, rowV of base colour, metallic-roughness, emission
  vec4 offset[3];   // xy: offset, z: 1 for texture coordinate set 1
};

layout(std430, binding = 0) readonly buffer SideBlock { Side sideRecords[]; };
layout(std430, binding = 1) readonly buffer MaterialBlock { Material materials[]; };

layout(binding = 3) uniform sampler2D specularTable;  // at x: cosθ, y: √α: scale, bias, mean of their sum over the hemisphere
#ifdef TEXTURED
layout(binding = 4) uniform sampler2D baseColorTexture;
layout(binding = 5) uniform sampler2D metallicRoughnessTexture;
layout(binding = 6) uniform sampler2D emissiveTexture;
#endif
layout(binding = 8) uniform usampler2D ownerImage;

uniform int materialIndex;
uniform float cellSharpness;  // λ of a cell of Ω
uniform float capCosine;      // of the radius of a cap as large as a cell

const float kPi = 3.14159265358979;
const float kMinAlpha = 1e-3;

// To be asked after the textures are read: pixels given up before would leave their neighbours without derivatives, and
// with a wrong mipmap along the borders of charts.
bool ownsPixel() { return texelFetch(ownerImage, ivec2(gl_FragCoord.xy), 0).r == v.sides.x; }

uint visibleRecord() { return gl_FrontFacing ? v.sides.x : v.sides.y; }
Side visibleSide() { return sideRecords[visibleRecord()]; }

// Shading normal on the visible side.
vec3 shadingNormal() { return normalize(gl_FrontFacing ? v.normal : -v.normal); }

#ifdef TEXTURED
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
#else
float lobeWidth(float alpha) {
  float lobe = 0.5 * (1.0 / (alpha * alpha) + 1.0);
  return lobe * cellSharpness / (lobe + cellSharpness);
}

float lobeWeight(float sharpness, vec3 r, vec3 d, vec3 n) { return exp(max(sharpness * (dot(r, d) - 1.0), -60.0)); }
#endif
