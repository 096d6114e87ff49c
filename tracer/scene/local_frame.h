// The local frame of a scene (scene.h), from the box that its triangles fill. One function for all who make scenes, so
// that the same geometry gets the same bits whatever it came from.
#pragma once

#include "tracer/scene/scene.h"

namespace lucarne {

/// Origin at the box's centre, scale the power of two that brings its largest extent into [1, 2) local units. A box
/// that is one point has the scale 1. `metres` must not be empty and its extent must be finite.
LocalFrame localFrameOf(const Box& metres);

/// Position in single precision; the subtraction is done in double, so that scenes far from the origin lose nothing.
inline Vec3f localPosition(const LocalFrame& frame, Vec3d metres) { return Vec3f(frame.toLocal(metres)); }

}  // namespace lucarne
