
// What a fragment is: its chart side, its shading frame, its material, and the lobe that it looks along. The formulas are those
// of lobe.h.

in Vertex {
  vec3 fromEye;
  vec3 normal;
  vec4 uv;
  vec2 chartUv;
  flat uvec2 sides;
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

const float kPi = 3.14159265358979;
const float kMinAlpha = 1e-3;

// To be asked after the textures are read: pixels given up before would leave their neighbours without derivatives, and
// with a wrong mipmap along the borders of charts.
bool ownsPixel() { return texelFetch(ownerImage, ivec2(gl_FragCoord.xy), 0).r == v.sides.x; }

Side visibleSide() { return sideRecords[gl_FrontFacing ? v.sides.x : v.sides.y]; }

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

float lobeSharpness(float alpha) {
  float lobe = 0.5 * (1.0 / (alpha * alpha) + 1.0);
  return lobe * cellSharpness / (lobe + cellSharpness);
}

// The way the mirror of the shading normal sends the eye's ray; kept above the horizon.
vec3 mirrorDirection(vec3 n) {
  vec3 toEye = -normalize(v.fromEye);
  vec3 r = 2.0 * dot(n, toEye) * n - toEye;
  return normalize(r - n * min(dot(n, r), 0.0));
}

float lobeWeight(float sharpness, float cosine) { return exp(max(sharpness * (cosine - 1.0), -60.0)); }
