// The irradiance of light maps out of the layers of irradiance.exr.
#pragma once

#include <filesystem>

#include "dlm/manifest.h"

namespace lucarne {

/// Fills the texels of the irradiance and what is known of it. InputError names the file.
void readIrradiance(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps);

}  // namespace lucarne
