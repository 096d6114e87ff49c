
// One ψ of the multipass renderer: adds (B·w, C·w) where the visible side has it.

struct MemberBits {  // of 32 ψ: which are stored or empty members of a side, and how many come before these 32
  uint stored, storedBefore, empty, emptyBefore;
};
layout(std430, binding = 3) readonly buffer MemberBlock { MemberBits memberBits[]; };
uniform ivec2 direction;  // ψ, words a side

layout(location = 0) out vec4 sums;

vec4 lobeTerm(Side side, uint rank, bool isStored, float alpha) {
  vec3 n = shadingNormal();
  vec4 cell = cellAt(side.firstCell + rank, octahedral(n));
  float w = lobeWeight(lobeWidth(alpha), mirrorDirection(n), cell.xyz, n);
  vec3 value = vec3(0);
  if (isStored) {
    uint strip = rank / uint(layersPerStrip);
    vec2 texel = side.mapOrigin + texelPosition(side) + vec2(float(strip) * side.size.x, 0);
    value = mapValue(texel / vec2(textureSize(maps, 0).xy), side.firstLayer + rank - strip * uint(layersPerStrip));
  }
  return vec4(value, cell.w) * w;
}

void main() {
  float alpha = materialAlpha(materials[materialIndex]);
  uint id = gl_FrontFacing ? v.sides.x : v.sides.y;
  MemberBits bits = memberBits[id * uint(direction.y) + uint(direction.x >> 5)];
  uint bit = 1u << uint(direction.x & 31);
  bool isStored = (bits.stored & bit) != 0u, isEmpty = (bits.empty & bit) != 0u;
  if (!ownsPixel() || (!isStored && !isEmpty)) discard;
  Side side = sideRecords[id];
  uint rank = isStored ? bits.storedBefore + bitCount(bits.stored & (bit - 1u))
                       : side.stored + bits.emptyBefore + bitCount(bits.empty & (bit - 1u));
  sums = lobeTerm(side, rank, isStored, alpha);
}
