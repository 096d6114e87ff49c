// A look at an OpenEXR header before the library sees it: the library believes the lengths that stand in a file and
// allocates them, up to 2 GiB an attribute.
#pragma once

#include "base/input_file.h"

namespace lucarne {

enum class ExrTiles { refused, read };

/// InputError when the file is no OpenEXR file, when it is deep, tiled though `tiles` refuses that, or says two things
/// about it, or when an attribute is longer than the file.
void scanExrHeader(const InputFile& file, ExrTiles tiles);

}  // namespace lucarne
