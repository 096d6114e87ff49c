#include "player/camera_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "base/error.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {
namespace {

constexpr double kPi = std::numbers::pi, kInsideFov = 1.0, kOutsideFov = 0.8;
constexpr double kEyeHeightMetres = 1.6;

std::string listOf(const Scene& scene) {
  if (scene.cameras.empty()) return "the scene has none";
  std::string list = "there are";
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    list += (i ? ", " : " ") + std::to_string(i);
    if (!scene.cameras[i].name.empty()) list += " \"" + scene.cameras[i].name + "\"";
  }
  return list;
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Rays of one scene, and how large it is.
class Scout {
 public:
  explicit Scout(const Scene& scene) : scene_(scene), caster_(scene) {
    for (const Triangle& t : scene.triangles) {
      for (const std::uint32_t v : t.v) box_.add(Vec3d(scene.positions[v]));
    }
  }

  const Box& box() const { return box_; }
  double size() const { return std::max(length(box_.extent()), 1e-9); }

  struct Sight {
    double worth = 0;  // up to 1 for a front some way off, 0 for nothing, −1 for a back that should not be seen
    std::uint32_t material = kNone;
  };
  Sight sight(Vec3d eye, Vec3d direction) const {
    std::uint64_t repeats = 0;
    const std::optional<Hit> hit = caster_.nearest(Vec3f(eye), Vec3f(direction), kNone, repeats);
    if (!hit) return {};
    const std::uint32_t material = scene_.triangles[hit->triangle].material;
    if (hit->back && !scene_.materials[material].doubleSided) return {-1, material};
    return {std::min(length(hit->position - eye) / (0.5 * size()), 1.0), material};
  }

  /// Mean worth over the picture of a camera, 4:3, and up to as much again for many different materials in it.
  double score(const Camera& camera) const {
    constexpr int kColumns = 12, kRows = 9;
    const double y = std::tan(camera.yfov / 2), x = y * kColumns / kRows;
    double sum = 0;
    std::set<std::uint32_t> materials;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const double u = (2 * (column + 0.5) / kColumns - 1) * x, v = (2 * (row + 0.5) / kRows - 1) * y;
        const Sight s = sight(camera.position, normalize(camera.right * u + camera.up * v - camera.back));
        sum += s.worth;
        if (s.worth > 0) materials.insert(s.material);
      }
    }
    const auto known = static_cast<double>(std::min<std::size_t>(scene_.materials.size(), 16));
    return sum / (kColumns * kRows) + static_cast<double>(materials.size()) / std::max(known, 1.);
  }

  /// Share of all directions in which a front is met.
  double enclosure(Vec3d eye) const {
    constexpr int kRays = 96;
    int fronts = 0;
    for (int i = 0; i < kRays; ++i) {
      const double z = 1 - 2 * (i + 0.5) / kRays, s = std::sqrt(1 - z * z), phi = 2.399963229728653 * i;
      fronts += sight(eye, {s * std::cos(phi), z, s * std::sin(phi)}).worth > 0 ? 1 : 0;
    }
    return static_cast<double>(fronts) / kRays;
  }

 private:
  const Scene& scene_;
  RayCaster caster_;
  Box box_;
};

/// A grid of standing places inside the box.
std::vector<Vec3d> standingPlaces(const Scene& scene, const Box& box) {
  const Vec3d e = box.extent();
  const double eye = box.lo.y + std::min(kEyeHeightMetres / scene.frame.scale, 0.55 * e.y);
  std::vector<Vec3d> places;
  for (const double x : {0.5, 0.3, 0.7, 0.08, 0.92}) {
    for (const double z : {0.5, 0.3, 0.7, 0.08, 0.92}) places.push_back({box.lo.x + x * e.x, eye, box.lo.z + z * e.z});
  }
  return places;
}

struct Best {
  Camera camera;
  double score = -2;
  void consider(const Scout& scout, const Camera& candidate) {
    const double s = scout.score(candidate);
    if (s > score + 1e-9) *this = {candidate, s};
  }
};

Best bestInside(const Scout& scout, const std::vector<Vec3d>& places) {
  Best best;
  for (const Vec3d& eye : places) {
    for (int i = 0; i < 16; ++i) {
      const double yaw = kPi * i / 8;
      best.consider(scout, lookAt(eye, eye + Vec3d{std::cos(yaw), -0.2, std::sin(yaw)}, kInsideFov));
    }
  }
  return best;
}

Best bestOutside(const Scout& scout) {
  const Vec3d center = scout.box().center();
  const double distance = 0.5 * scout.size() / std::sin(kOutsideFov / 2) * 1.05;
  Best best;
  for (const double elevation : {0.35, 0.1, 0.8, 1.3, -0.4, -1.3}) {
    for (int i = 0; i < 12; ++i) {
      const double yaw = kPi * (i / 6.0 + 0.3), level = std::cos(elevation) * distance;
      const Vec3d eye = center + Vec3d{std::cos(yaw) * level, std::sin(elevation) * distance, std::sin(yaw) * level};
      best.consider(scout, lookAt(eye, center, kOutsideFov));
    }
  }
  return best;
}

}  // namespace

Camera lookAt(Vec3d eye, Vec3d target, double yfov) {
  Camera camera;
  camera.position = eye;
  camera.yfov = yfov;
  camera.back = normalize(eye - target);
  if (camera.back == Vec3d{}) camera.back = {0, 0, 1};
  const Vec3d side = cross(Vec3d{0, 1, 0}, camera.back);
  camera.right = length(side) > 1e-9 ? normalize(side) : Vec3d{1, 0, 0};
  camera.up = cross(camera.back, camera.right);
  return camera;
}

Camera automaticCamera(const Scene& scene) {
  if (scene.triangles.empty()) return lookAt({0, 0, 2}, {0, 0, 0}, kOutsideFov);
  const Scout scout(scene);
  const std::vector<Vec3d> places = standingPlaces(scene, scout.box());
  std::vector<Vec3d> enclosed;
  for (const Vec3d& eye : places) {
    if (scout.enclosure(eye) >= 0.7) enclosed.push_back(eye);  // a room may lack a wall or its roof
  }
  if (!enclosed.empty()) return bestInside(scout, enclosed).camera;
  const Best inside = bestInside(scout, places), outside = bestOutside(scout);
  return inside.score > outside.score ? inside.camera : outside.camera;
}

Camera chooseCamera(const Scene& scene, const std::string& nameOrIndex) {
  if (nameOrIndex.empty()) return scene.cameras.empty() ? automaticCamera(scene) : scene.cameras.front();
  for (const Camera& camera : scene.cameras) {
    if (camera.name == nameOrIndex) return camera;
  }
  if (isNumber(nameOrIndex)) {
    const auto index = static_cast<std::size_t>(std::stoul(nameOrIndex));
    if (index < scene.cameras.size()) return scene.cameras[index];
  }
  throw UsageError("--camera " + nameOrIndex + ": no such camera; " + listOf(scene));
}

}  // namespace lucarne
