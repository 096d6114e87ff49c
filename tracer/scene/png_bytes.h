// PNG without compression, for the images of scenes made in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// A valid RGBA PNG file whose data are stored, not deflated.
std::vector<std::uint8_t> storedPng(const Image& image);

}  // namespace lucarne
