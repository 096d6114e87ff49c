
// One ψ of the multipass renderer: adds (B·w, C·w) where the visible side has it, and under a normal map the same with
// reliefWeight().
uniform ivec2 direction;  // ψ, words a side

layout(location = 0) out vec4 sums;
#ifdef RELIEF
layout(location = 1) out vec4 reliefSums;
#endif

void main() {
  Material m = materials[materialIndex];
  uint id = visibleRecord();
  Member member = memberOf(id, direction.x, direction.y);
  float alpha = materialAlpha(m);
  vec3 n = interpolatedNormal(), mapped = shadingNormal(m);
  if (!ownsPixel() || !member.isMember) discard;
  Side side = sideRecords[id];
  vec4 cell = cellAt(side.firstCell + member.rank, octahedral(n));
  vec4 light = vec4(0, 0, 0, cell.w);
  if (member.isStored) light.rgb = storedLight(side, member.rank);
  sums = light * lobeWeight(lobeWidth(alpha), mirrorDirection(mapped), cell.xyz, mapped);
#ifdef RELIEF
  reliefSums = light * reliefWeight(n, mapped, cell.xyz);
#endif
}
