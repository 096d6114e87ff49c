
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

// Where the side's map of rank `rank` lies: place on its page, layer.
vec3 storedPlace(Side side, uint rank) {
  uint strip = rank / uint(layersPerStrip);
  vec2 texel = side.mapOrigin + texelPosition(side) + vec2(float(strip) * side.size.x, 0);
  return vec3(texel / vec2(textureSize(maps, 0).xy), float(side.firstLayer + rank - strip * uint(layersPerStrip)));
}

// What it holds, in stored units.
vec3 storedLight(Side side, uint rank) {
  vec3 place = storedPlace(side, rank);
  return mapValue(place.xy, uint(place.z));
}

#ifdef MEAN_LIGHT
vec3 storedMean(Side side, uint rank) {
  vec3 place = storedPlace(side, rank);
  return meanValue(place.xy, uint(place.z), side.firstCell + rank);
}
#endif
