// The walkthrough of a .dlm in a window.
#pragma once

#include <filesystem>

#include "player/play.h"

namespace lucarne {

/// Loads the light maps and plays them until the window is closed.
PlayReport walk(const std::filesystem::path& dlm, PlayOptions options);

}  // namespace lucarne
