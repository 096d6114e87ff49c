
// What a view needs to be seen: light gets exposure and tone curve, numbers heat colours, colours nothing; then sRGB. The twin of
// display_image.cpp. The window is a plain 8-bit target, no encoding by the driver. Right of the divider another picture of
// light is shown.
layout(binding = 0) uniform sampler2D frameImage;
layout(binding = 1) uniform sampler2D otherImage;
uniform float exposure;  // of numbers: one over what the palest colour stands for
uniform ivec2 mode;      // ViewScale, ToneCurve
uniform vec2 divider;    // where the other picture begins, 0 … 1; half the width of the line between
in vec2 screenUv;
layout(location = 0) out vec4 color;

vec3 filmic(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }
vec3 encodeSrgb(vec3 c) { return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308))); }

const vec3 kHeat[9] = HEAT_COLOURS;
vec3 heat(float value) {
  float place = clamp(value, 0.0, 1.0) * 8.0;
  int i = min(int(place), 7);
  return mix(kHeat[i], kHeat[i + 1], place - float(i));
}

vec3 shownLight(vec3 radiance) {
  vec3 x = clamp(radiance * exposure, 0.0, 1e4);
  return encodeSrgb(mode.y == 0 ? filmic(x) : min(x, 1.0));
}

void main() {
  vec3 value = textureLod(frameImage, screenUv, 0.0).rgb;
  if (screenUv.x > divider.x) {
    color.rgb = shownLight(textureLod(otherImage, screenUv, 0.0).rgb);
  } else if (mode.x == 0) {
    color.rgb = shownLight(value);
  } else {
    color.rgb = mode.x == 1 ? heat(value.r * exposure) : encodeSrgb(clamp(value, 0.0, 1.0));
  }
  if (abs(screenUv.x - divider.x) < divider.y) color.rgb = vec3(1);
  // Brightness, for smooth_edges.glsl; the noise of the other picture is no edge.
  color.a = screenUv.x > divider.x ? 0.5 : dot(color.rgb, vec3(0.299, 0.587, 0.114));
}
