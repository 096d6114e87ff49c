
// One ψ of the multipass renderer: adds (B·w, C·w) where the visible side has it.
uniform ivec2 direction;  // ψ, words a side

layout(location = 0) out vec4 sums;

vec4 lobeTerm(Side side, Member member, float alpha) {
  vec3 n = shadingNormal();
  vec4 cell = cellAt(side.firstCell + member.rank, octahedral(n));
  float w = lobeWeight(lobeWidth(alpha), mirrorDirection(n), cell.xyz, n);
  vec3 value = vec3(0);
  if (member.isStored) value = storedLight(side, member.rank);
  return vec4(value, cell.w) * w;
}

void main() {
  float alpha = materialAlpha(materials[materialIndex]);
  uint id = visibleRecord();
  Member member = memberOf(id, direction.x, direction.y);
  if (!ownsPixel() || !member.isMember) discard;
  sums = lobeTerm(sideRecords[id], member, alpha);
}
