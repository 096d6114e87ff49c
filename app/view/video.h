// A video of numbered pictures, by the program ffmpeg where it is installed.
#pragma once

#include <filesystem>

namespace lucarne {

/// False where there is no ffmpeg in PATH. Makes the H.264 video `output` of frame_00000.png … in `folder`, aside, then
/// renamed. Error(failed) with ffmpeg's last words when it fails.
bool makeVideo(const std::filesystem::path& folder, double fps, const std::filesystem::path& output);

}  // namespace lucarne
