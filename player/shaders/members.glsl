
// Which ψ a side has, and where in its list.

struct MemberBits {  // of 32 ψ: which are stored or empty members of a side, and how many come before these 32
  uint stored, storedBefore, empty, emptyBefore;
};
layout(std430, binding = 3) readonly buffer MemberBlock { MemberBits memberBits[]; };

struct Member {
  bool isMember, isStored;
  uint rank;  // in the side's list
};

// `words`: of 32 ψ, that a side has.
Member memberOf(uint id, int psi, int words) {
  MemberBits bits = memberBits[id * uint(words) + uint(psi >> 5)];
  uint bit = 1u << uint(psi & 31);
  Member m;
  m.isStored = (bits.stored & bit) != 0u;
  m.isMember = m.isStored || (bits.empty & bit) != 0u;
  m.rank = m.isStored ? bits.storedBefore + bitCount(bits.stored & (bit - 1u))
                      : sideRecords[id].stored + bits.emptyBefore + bitCount(bits.empty & (bit - 1u));
  return m;
}

// What the side's map of rank `rank` holds, in stored units.
vec3 storedLight(Side side, uint rank) {
  uint strip = rank / uint(layersPerStrip);
  vec2 texel = side.mapOrigin + texelPosition(side) + vec2(float(strip) * side.size.x, 0);
  return mapValue(texel / vec2(textureSize(maps, 0).xy), side.firstLayer + rank - strip * uint(layersPerStrip));
}
