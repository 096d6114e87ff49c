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

/// Sliders and choices, where the panel is open.
void drawLookPanel(LookSettings& look, int directionCount);

/// The line between the picture and the truth, to be dragged.
void drawDivider(LookSettings& look, const std::string& state);

/// What the light maps say of the place that was asked for.
void drawInspection(const Inspection& inspection);

/// A line a key.
extern const char* const kLookKeysHelp;

}  // namespace lucarne
