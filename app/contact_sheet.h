// The atlas of a .dlm as one picture that a person can look through.
#pragma once

#include <filesystem>

#include "base/canvas.h"
#include "dlm/dlm_reader.h"

namespace lucarne {

/// Panels of the irradiance, its estimated error, the photons, and the light of each direction, of fronts and (where
/// some are lit) of backs. Of more than 64 directions those with the most light. Atlases larger than a panel are
/// averaged.
Canvas contactSheet(const Dlm& dlm, const std::string& name);

/// Reads light maps and writes their sheet as a PNG. UsageError where `dlm` is no folder or `picture` no .png.
void writeContactSheet(const std::filesystem::path& dlm, const std::filesystem::path& picture);

}  // namespace lucarne
