// Where a picture is taken from.
#pragma once

#include <string>

#include "tracer/scene/scene.h"

namespace lucarne {

/// The scene's camera of that name, else of that number (from 0). Empty: the first one, or automaticCamera() where
/// there is none. Error(usage) lists the cameras there are.
Camera chooseCamera(const Scene& scene, const std::string& nameOrIndex);

/// A view found by casting rays from many places: inside a scene that closes around the eye (at eye height, toward
/// where most fronts are seen at middling distances), from outside for a lone object. Deterministic.
Camera automaticCamera(const Scene& scene);

/// At `eye` looking at `target`, upright (y up).
Camera lookAt(Vec3d eye, Vec3d target, double yfov);

}  // namespace lucarne
