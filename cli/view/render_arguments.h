// Options that render and play share.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "player/render_options.h"

namespace lucarne {

/// Adds --size, --renderer and --map-format. `size` is parsed by applySize() when the command runs. `pathtraced` is among
/// the renderers, and there is --lobe, only where asked for.
void addRenderArguments(CLI::App& cmd, RenderOptions& options, std::string& size, bool withPathTracer);

/// "1280x720" into width and height; UsageError otherwise.
void applySize(const std::string& size, RenderOptions& options);

}  // namespace lucarne
