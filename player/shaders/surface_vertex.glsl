
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv0;
layout(location = 3) in vec2 uv1;
layout(location = 4) in vec2 chartUv;
layout(location = 5) in uvec2 sides;
#ifdef RELIEF
layout(location = 6) in vec4 tangent;
#endif

invariant gl_Position;

out Vertex {
  vec3 fromEye;
  vec3 normal;
  vec4 uv;       // set 0, set 1
  vec2 chartUv;  // 0..1 over the chart's rectangle
  flat uvec2 sides;
#ifdef RELIEF
  vec4 tangent;
#endif
#ifdef VIEW
  vec3 corner;  // barycentric coordinates
#endif
} v;

void main() {
  gl_Position = clipPosition(position);
  v.fromEye = position - camera.eye.xyz;
  v.normal = normal;
  v.uv = vec4(uv0, uv1);
  v.chartUv = chartUv;
  v.sides = sides;
#ifdef RELIEF
  v.tangent = tangent;
#endif
#ifdef VIEW
  int k = gl_VertexID % 3;  // triangles have their corners to themselves
  v.corner = vec3(k == 0, k == 1, k == 2);
#endif
}
