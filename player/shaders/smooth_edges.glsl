
// Softens stairs along edges in the finished picture: after Lottes 2009, "FXAA" (whitepaper), the short form. Where brightness
// changes sharply, the pixel is blurred along the edge, by as much as a box a few pixels long would have covered. Even places
// are left as they are.
layout(binding = 0) uniform sampler2D picture;  // alpha: brightness
in vec2 screenUv;
layout(location = 0) out vec4 color;

const float kLeastContrast = 1.0 / 24.0, kRelativeContrast = 1.0 / 8.0, kLongest = 8.0;

float brightness(vec2 uv) { return textureLod(picture, uv, 0.0).a; }

void main() {
  vec2 pixel = 1.0 / vec2(textureSize(picture, 0));
  vec4 middle = textureLod(picture, screenUv, 0.0);
  float nw = brightness(screenUv + vec2(-0.5, 0.5) * pixel * 2.0), ne = brightness(screenUv + vec2(0.5, 0.5) * pixel * 2.0);
  float sw = brightness(screenUv + vec2(-0.5, -0.5) * pixel * 2.0), se = brightness(screenUv + vec2(0.5, -0.5) * pixel * 2.0);
  float least = min(middle.a, min(min(nw, ne), min(sw, se))), most = max(middle.a, max(max(nw, ne), max(sw, se)));
  color = vec4(middle.rgb, 1);
  if (most - least < max(kLeastContrast, most * kRelativeContrast)) return;
  vec2 along = vec2((sw + se) - (nw + ne), (nw + sw) - (ne + se));
  along = vec2(along.x, -along.y);
  float damp = max((nw + ne + sw + se) * 0.03125, 1.0 / 128.0);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + damp), -kLongest, kLongest) * pixel;
  vec3 narrow = 0.5 * (textureLod(picture, screenUv - along / 6.0, 0.0).rgb + textureLod(picture, screenUv + along / 6.0, 0.0).rgb);
  vec3 wide = 0.5 * narrow + 0.25 * (textureLod(picture, screenUv - along * 0.5, 0.0).rgb + textureLod(picture, screenUv + along * 0.5, 0.0).rgb);
  float b = dot(wide, vec3(0.299, 0.587, 0.114));
  color.rgb = b < least || b > most ? narrow : wide;
}
