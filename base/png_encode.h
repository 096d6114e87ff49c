// PNG in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lucarne {

/// 8-bit RGB (3 bytes a pixel, display codes), top row first. Error(outOfResource) without memory, Error(failed) for a
/// picture that is too large for the encoder.
std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace lucarne
