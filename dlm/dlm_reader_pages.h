// The texels of light maps out of the layers of irradiance.exr, directional.exr and moments.exr.
#pragma once

#include <filesystem>
#include <functional>

#include "dlm/manifest.h"

namespace lucarne {

/// Reads the image files and fills all texels. InputError names the file. `betweenFiles` is called after the irradiance.
LightMaps readPages(const std::filesystem::path& folder, ManifestContents contents,
                    const std::function<void()>& betweenFiles);

}  // namespace lucarne
