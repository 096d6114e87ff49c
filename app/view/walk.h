// The walkthrough of a .dlm in a window.
#pragma once

#include <filesystem>

#include "app/bake_options.h"
#include "player/play.h"

namespace lucarne {

/// Loads the light maps and the sky, which light maps do not keep, and plays them until the window is closed.
PlayReport walk(const std::filesystem::path& dlm, PlayOptions options, const BakeOptions& sky);

}  // namespace lucarne
