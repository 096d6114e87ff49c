
// What is seen where there is no surface: the sky, an equirectangular map. Its rows go from +y down, its centre column is
// +x, and columns to the right turn from +x to +z, as in tracer/optics/environment.h.
layout(binding = 0) uniform sampler2D skyImage;
uniform float outputScale;
in vec2 screenUv;
layout(location = 0) out vec4 color;

void main() {
  vec2 p = (screenUv * 2.0 - 1.0 - camera.projection.zw) / camera.projection.xy;
  vec3 d = normalize(camera.right.xyz * p.x + camera.up.xyz * p.y - camera.back.xyz);
  vec2 uv = vec2(atan(d.z, d.x) / 6.28318531 + 0.5, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265);
  color = vec4(textureLod(skyImage, uv, 0.0).rgb * outputScale, 1);
}
