
// Last pass of the multipass renderer: the sums of all ψ are there, the rest of the formula is the same.
layout(binding = 7) uniform sampler2D lobeImage;
layout(location = 0) out vec4 color;

void main() {
  vec4 lobe = texelFetch(lobeImage, ivec2(gl_FragCoord.xy), 0);
  color = vec4(outgoingRadiance(visibleSide(), materials[materialIndex], shadingNormal(), lobe) * outputScale, 1);
  if (!ownsPixel()) discard;
}
