// Pixels from the GPU to memory.
#pragma once

#include "base/image_file.h"
#include "player/frame_target.h"

namespace lucarne {

/// target.color, top row first. Waits for the driver.
ImageRgb readBack(const FrameTarget& target);

}  // namespace lucarne
