
// Exposure, tone curve and sRGB encoding; the twin of tonemap.cpp. The window is a plain 8-bit target, no encoding by the driver.
layout(binding = 0) uniform sampler2D radianceImage;
uniform float exposure;
in vec2 screenUv;
layout(location = 0) out vec4 color;

vec3 filmic(vec3 x) {
  x = max(x, vec3(0));
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}
vec3 encodeSrgb(vec3 c) { return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308))); }

void main() {
  vec3 radiance = min(textureLod(radianceImage, screenUv, 0.0).rgb * exposure, vec3(1e4));
  color = vec4(encodeSrgb(filmic(radiance)), 1);
}
