// Opening an OpenEXR file with every size in it checked, before any pixel is read: what the readers of layers and of
// plain pictures share.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/exr_header_scan.h"
#include "base/input_file.h"

namespace lucarne {

struct WindowSize {
  std::int64_t width, height;
};

/// Of a window of pixels, both corners included; not clamped, so 0 or less for one that is inside out.
WindowSize sizeOf(const IMATH_NAMESPACE::Box2i& window);

/// Calls `use` on the opened and checked file: no layer is deep or subsampled, none is tiled unless `tiles` allows it,
/// and what decoding all of them takes is believable for the file's length (checkImageSize). The library's exceptions
/// become InputErrors that name the file.
void withExr(const std::filesystem::path& path, ExrTiles tiles,
             const std::function<void(OPENEXR_IMF_NAMESPACE::MultiPartInputFile&, const InputFile& file)>& use);

}  // namespace lucarne
