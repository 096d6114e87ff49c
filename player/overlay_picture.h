// The walkthrough's text over a finished picture.
#pragma once

#include <cstdint>
#include <vector>

#include "player/overlay.h"

namespace lucarne {

/// `rgb`: text.width × text.height pixels of 3 bytes, top row first. Needs no display and no context: it makes one of its
/// own. Error(failed) without OpenGL 4.5.
void drawOverlayOver(std::vector<std::uint8_t>& rgb, const OverlayText& text, const LookSettings& look);

}  // namespace lucarne
