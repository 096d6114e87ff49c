// |Ω| from what the scene's surfaces can show.
#pragma once

#include "tracer/scene/scene.h"

namespace lucarne {

struct DirectionChoice {
  int directions = 0;
  double glossy = 0;  // share of the surface that has a glossy lobe
  double shown = 0;   // of it, weighed by how much it reflects: share with lobes that need not be widened
};

/// The least of 14, 32 and 64 that shows nine tenths of the glossy surface, weighed by area and by what its coat reflects
/// straight on, as sharp as its material is (lobe_width.h); 64 where none does. More are left to who asks for them:
/// tallies, disk and frame time grow in proportion. Roughness textures, which only make sharper, do not count. A scene
/// without glossy surfaces needs none: 14.
DirectionChoice chooseDirections(const Scene& scene);

}  // namespace lucarne
