
layout(std140, binding = 0) uniform CameraBlock {
  vec4 eye;         // local; w: near distance
  vec4 right, up, back;
  vec4 projection;  // x, y: cot(fov/2); z, w: shift of the image centre in clip units (jitter)
} camera;

// Reversed depth with the far plane at infinity: depth = near / distance. The eye is subtracted before anything is turned, so
// that small things far from the origin of the scene stay steady.
vec4 clipPosition(vec3 position) {
  vec3 e = position - camera.eye.xyz;
  vec3 c = vec3(dot(camera.right.xyz, e), dot(camera.up.xyz, e), dot(camera.back.xyz, e));
  return vec4(c.x * camera.projection.x - c.z * camera.projection.z, c.y * camera.projection.y - c.z * camera.projection.w,
              camera.eye.w, -c.z);
}
