
layout(location = 0) in vec3 position;
layout(location = 5) in uvec2 sides;

// All passes after this one test for equal depth: the same expression, invariant, in every program.
invariant gl_Position;
flat out uint owner;

void main() {
  gl_Position = clipPosition(position);
  owner = sides.x;
}
