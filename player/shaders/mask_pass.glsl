
// Depth pre-pass of materials with holes: what alpha cuts out, and the backs of what has only a front.
layout(location = 0) out uint ownerOut;

void main() {
  Material m = materials[materialIndex];
  if (coverage(m) <= 0.0 || (m.more.z < 0.0 && !gl_FrontFacing)) discard;
  ownerOut = v.sides.x;
}
