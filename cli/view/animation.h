// The options of render that make an animation instead of a picture.
#pragma once

#include <CLI/CLI.hpp>

#include "app/view/animate.h"
#include "app/view/render.h"

namespace lucarne {

void addAnimationArguments(CLI::App& cmd, AnimationJob& animation);

/// Makes the animation, with what `picture` says of maps, output and looks, and tells of it. False where none is asked
/// for. UsageError for options that do not go together.
bool animateIfAsked(AnimationJob animation, const RenderJob& picture);

}  // namespace lucarne
