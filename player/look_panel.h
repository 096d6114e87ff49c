// Keys and controls of the look; all but the keys inside a frame of Dear ImGui.
#pragma once

#include <string>
#include <vector>

#include "player/inspector.h"
#include "player/key_press.h"
#include "player/look_settings.h"

namespace lucarne {

/// Keys pressed since the last frame.
void handleLookKeys(LookSettings& look, int directionCount, const std::vector<KeyPress>& presses);
/// The right button asks what is under it, or in the middle of the picture while the mouse turns the head.
void handleLookMouse(LookSettings& look);

/// Sliders and choices, where the panel is open: at first in the upper right corner, no higher than `height` pixels.
void drawLookPanel(LookSettings& look, int directionCount, float height);

/// The line between the picture and the truth, to be dragged.
void drawDivider(LookSettings& look, const std::string& state);

/// What the light maps say of the place that was asked for, in the lower right corner. Returns the height in pixels that it
/// took in the frame before.
float drawInspection(const Inspection& inspection);

/// A line a key.
extern const char* const kLookKeysHelp;

}  // namespace lucarne
