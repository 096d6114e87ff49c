// What the headers of an OpenEXR file say of its layers.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <vector>

#include "base/image_file.h"

namespace lucarne {

/// All of a layer but the values.
ExrLayer headOf(const OPENEXR_IMF_NAMESPACE::Header& header);
std::vector<ExrLayer> headsOf(const OPENEXR_IMF_NAMESPACE::MultiPartInputFile& input);

}  // namespace lucarne
