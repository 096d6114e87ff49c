
// Last pass of the multipass renderer: the sums of all ψ are there, the rest of the formula is the same.
layout(binding = 7) uniform sampler2D lobeImage;
#ifdef RELIEF
layout(binding = 11) uniform sampler2D reliefImage;
#endif
layout(location = 0) out vec4 color;

void main() {
  Material m = materials[materialIndex];
  LightSums sums = LightSums(texelFetch(lobeImage, ivec2(gl_FragCoord.xy), 0), vec4(0));
#ifdef RELIEF
  sums.relief = texelFetch(reliefImage, ivec2(gl_FragCoord.xy), 0);
#endif
  color = vec4(outgoingRadiance(visibleSide(), m, shadingNormal(m), sums) * outputScale, 1);
  if (!ownsPixel()) discard;
}
