// Options that render and play share.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "player/display_image.h"
#include "player/render_options.h"

namespace lucarne {

/// Adds --size, --renderer, --map-format, --gpu-memory and --lobe. `size` is parsed by applySize() when the command
/// runs. `pathtraced` is among the renderers only where asked for.
void addRenderArguments(CLI::App& cmd, RenderOptions& options, std::string& size, bool withPathTracer);

/// --view and --psi.
void addViewArguments(CLI::App& cmd, View& view);
/// --tonemap.
void addToneCurve(CLI::App& cmd, ToneCurve& curve);
/// "auto" or a number; UsageError otherwise.
void applyExposure(const std::string& exposure, DisplayOptions& options);

/// "1280x720" into width and height; UsageError otherwise.
void applySize(const std::string& size, RenderOptions& options);

}  // namespace lucarne
