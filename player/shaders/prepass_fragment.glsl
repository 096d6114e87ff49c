
// Where coplanar charts meet in one pixel at one depth, the one drawn first owns it; later passes compare. Without this the
// additive passes would sum the light of both.
flat in uint owner;
layout(location = 0) out uint ownerOut;

void main() { ownerOut = owner; }
