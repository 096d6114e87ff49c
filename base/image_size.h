// How large an image a file may claim to be.
#pragma once

#include <cstdint>
#include <string>

namespace lucarne {

/// Throws InputError naming `name` unless width and height are at least 1, the image has at most kMaxPixels pixels, and
/// its decoded size is believable for a file of `fileBytes`: at most 64 MiB + 4000 times the file (deflate reaches
/// 1000:1).
void checkImageSize(const std::string& name, std::int64_t width, std::int64_t height, std::uint64_t bytesPerPixel,
                    std::uint64_t fileBytes);

}  // namespace lucarne
