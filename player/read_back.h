// Pixels from the GPU to memory.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_file.h"
#include "player/frame_target.h"

namespace lucarne {

/// target.color, top row first. Waits for the driver.
ImageRgb readBack(const FrameTarget& target);
/// The colours of a framebuffer (0: the window's, before it is shown), 3 bytes a pixel, top row first. Likewise.
std::vector<std::uint8_t> readBackBytes(GLuint framebuffer, int width, int height);

}  // namespace lucarne
