// A recorded walk: where the eye was and how it looked, at a fixed rate. Poses, not keys: it can be walked again over
// other light maps of the scene, on any machine, at any frame rate, and written by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

struct WalkPose {
  Vec3d eye{};                // metres, in the scene's own coordinates
  double yaw = 0, pitch = 0;  // degrees; 0, 0 looks along −z, positive: to the left and up
  friend bool operator==(const WalkPose&, const WalkPose&) = default;
};

struct WalkPath {
  double rate = 1;   // poses a second
  double yfov = 45;  // degrees, of the picture's height
  std::vector<WalkPose> poses;

  /// From the first pose to the last.
  double seconds() const { return poses.size() < 2 ? 0 : static_cast<double>(poses.size() - 1) / rate; }
  /// Between poses on the straight line; before the first and after the last, that one.
  WalkPose at(double seconds) const;
};

inline constexpr std::size_t kMostPoses = 1'000'000;  // more than two hours of 120 a second

/// {"format": "lucarne-walk", "version": 1, "rate": 120, "yfov": 45, "poses": [[x, y, z, yaw, pitch], …]}
std::string textOf(const WalkPath& path);
/// InputError that names the file and the place in it.
WalkPath readWalkPath(const std::filesystem::path& file);

Camera cameraOf(const WalkPose& pose, double yfov, const LocalFrame& frame);
WalkPose poseOf(const Camera& camera, const LocalFrame& frame);

/// How many frames a path takes at `fps`, the first and the last pose included.
std::size_t frameCount(const WalkPath& path, double fps);

}  // namespace lucarne
