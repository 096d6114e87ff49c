
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
  vec3 light = member.isStored ? storedLight(side, member.rank) : vec3(0), r = mirrorDirection(mapped), mean = cell.xyz;
#ifdef MEAN_LIGHT
  if (member.isStored) mean = storedMean(side, member.rank);
#endif
  float width = lobeWidth(alpha);
  sums = vec4(light * lobeWeight(width, r, mean, mapped), cell.w * lobeWeight(width, r, cell.xyz, mapped));
#ifdef RELIEF
  reliefSums = vec4(light * reliefWeight(n, mapped, mean), cell.w * reliefWeight(n, mapped, cell.xyz));
#endif
}
