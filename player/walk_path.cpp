#include "player/walk_path.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr const char* kFormat = "lucarne-walk";
constexpr std::int64_t kVersion = 1;
constexpr std::uint64_t kLargestFile = std::uint64_t{256} << 20;
constexpr double kFarthest = 1e9, kMostTurned = 1e6;  // metres, degrees
constexpr double kDegree = std::numbers::pi / 180;

double numberWithin(const JsonView& view, double lowest, double highest) {
  const double value = view.number();
  if (!(value >= lowest && value <= highest))
    view.refuse("must be " + formatNumber(lowest) + " to " + formatNumber(highest));
  return value;
}

WalkPose readPose(const JsonView& view) {
  const std::vector<double> v = view.numbers(5);
  const auto within = [&](std::size_t i, double most) {
    if (!(std::abs(v[i]) <= most)) view.refuse("has a number that is too large");
    return v[i];
  };
  return {{within(0, kFarthest), within(1, kFarthest), within(2, kFarthest)}, within(3, kMostTurned), within(4, 90)};
}

double between(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

WalkPose WalkPath::at(double seconds) const {
  if (poses.empty()) return {};
  const double place = std::clamp(seconds * rate, 0.0, static_cast<double>(poses.size() - 1));
  const auto i = static_cast<std::size_t>(place);
  const WalkPose& a = poses[i];
  const double share = place - static_cast<double>(i);
  if (!(share > 0)) return a;
  const WalkPose& b = poses[i + 1];
  return {a.eye + (b.eye - a.eye) * share, between(a.yaw, b.yaw, share), between(a.pitch, b.pitch, share)};
}

std::string textOf(const WalkPath& path) {
  char line[256];
  std::snprintf(line, sizeof line,
                "{\"format\": \"%s\", \"version\": %d, \"rate\": %.17g, \"yfov\": %.17g, \"poses\": [\n", kFormat,
                static_cast<int>(kVersion), path.rate, path.yfov);
  std::string text = line;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const WalkPose& p = path.poses[i];
    std::snprintf(line, sizeof line, "[%.12g, %.12g, %.12g, %.10g, %.10g]%s\n", p.eye.x, p.eye.y, p.eye.z, p.yaw,
                  p.pitch, i + 1 < path.poses.size() ? "," : "");
    text += line;
  }
  return text + "]}\n";
}

WalkPath readWalkPath(const std::filesystem::path& file) {
  const nlohmann::json json = parseJson(readFile(file, kLargestFile), file.string());
  const JsonView view(json, file.string());
  if (!json.is_object() || !view.has("format") || view.at("format").text() != kFormat)
    throw InputError(file.string() + ": is not a recorded walk (play --record makes one)");
  if (view.at("version").integer(0, 1'000'000) != kVersion)
    view.at("version").refuse("is of another version of Lucarne");
  WalkPath path;
  path.rate = numberWithin(view.at("rate"), 1e-3, 1e4);
  path.yfov = numberWithin(view.at("yfov"), 1, 170);
  const JsonView poses = view.at("poses");
  if (!poses.json().is_array() || poses.size() == 0) poses.refuse("must be a list of poses, at least one");
  if (poses.size() > kMostPoses) poses.refuse("has more than " + std::to_string(kMostPoses) + " poses");
  path.poses.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) path.poses.push_back(readPose(poses.at(i)));
  return path;
}

Camera cameraOf(const WalkPose& pose, double yfov, const LocalFrame& frame) {
  const double yaw = pose.yaw * kDegree, pitch = pose.pitch * kDegree;
  Camera c;
  c.position = frame.toLocal(pose.eye);
  c.yfov = yfov * kDegree;
  c.right = {std::cos(yaw), 0, -std::sin(yaw)};
  c.back = {std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
  c.up = cross(c.back, c.right);
  return c;
}

WalkPose poseOf(const Camera& camera, const LocalFrame& frame) {
  return {frame.toWorld(camera.position), std::atan2(camera.back.x, camera.back.z) / kDegree,
          -std::asin(std::clamp(camera.back.y, -1., 1.)) / kDegree};
}

std::size_t frameCount(const WalkPath& path, double fps) {
  return static_cast<std::size_t>(std::floor(path.seconds() * fps + 1e-6)) + 1;
}

}  // namespace lucarne
