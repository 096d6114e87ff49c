#include "player/camera_choice.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {
namespace {

constexpr double kInsideFov = 1.0, kOutsideFov = 0.8;
constexpr double kEyeHeightMetres = 1.6;
constexpr double kEnclosed = 0.7;     // share of all directions: a room may lack a wall or its roof
constexpr double kRoomy = 0.45;       // Score::filled of a view inside a room, more than inside a lampshade
constexpr double kSurrounded = 0.55;  // and inside an open place, a courtyard or a garden

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
    std::uint32_t triangle = kNone;
  };
  Sight sight(Vec3d eye, Vec3d direction) const {
    std::uint64_t repeats = 0;
    const std::uint32_t triangle = caster_.nearest(Vec3f(eye), Vec3f(direction), kNone, repeats);
    if (triangle == kNone) return {};
    const Hit hit = caster_.intersect(triangle, Vec3f(eye), Vec3f(direction));
    if (hit.back && !scene_.materials[hit.material].doubleSided) return {-1, triangle};
    const double distance = length(hit.position - eye);
    return {distance / (distance + 0.1 * size()), triangle};
  }

  struct Score {
    double filled = -2;  // mean worth over the picture
    double variety = 0;  // half of it for many materials, half for many triangles
    double total() const { return filled + variety; }
  };
  /// Of a picture of 4:3.
  Score score(const Camera& camera) const {
    constexpr int kColumns = 12, kRows = 9;
    const double y = std::tan(camera.yfov / 2), x = y * kColumns / kRows;
    double sum = 0;
    std::set<std::uint32_t> materials, triangles;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const double u = (2 * (column + 0.5) / kColumns - 1) * x, v = (2 * (row + 0.5) / kRows - 1) * y;
        const Sight s = sight(camera.position, normalize(camera.right * u + camera.up * v - camera.back));
        sum += s.worth;
        if (s.worth <= 0) continue;
        triangles.insert(s.triangle);
        materials.insert(scene_.triangles[s.triangle].material);
      }
    }
    constexpr double kRays = kColumns * kRows;
    const auto known = static_cast<double>(std::clamp<std::size_t>(scene_.materials.size(), 1, 16));
    const auto seen = static_cast<double>(materials.size()), pieces = static_cast<double>(triangles.size());
    return {sum / kRays, 0.5 * std::min(seen / known, 1.0) + 0.5 * pieces / kRays};
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

/// The box that holds nine tenths of the corners along each axis: where the things are in a scene with a huge ground or
/// sky.
Box denseBox(const Scene& scene) {
  Box box;
  Vec3d lo, hi;
  std::vector<float> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const Triangle& t : scene.triangles) {
      for (const std::uint32_t v : t.v) values.push_back(scene.positions[v][axis]);
    }
    std::sort(values.begin(), values.end());
    lo[axis] = static_cast<double>(values[values.size() / 20]);
    hi[axis] = static_cast<double>(values[values.size() - 1 - values.size() / 20]);
  }
  box.add(lo);
  box.add(hi);
  return box;
}

/// A grid of standing places inside a box.
void addStandingPlaces(const Scene& scene, const Box& box, std::vector<Vec3d>& places) {
  const Vec3d e = box.extent();
  const double eye = box.lo.y + std::clamp(kEyeHeightMetres / scene.frame.scale, 0.2 * e.y, 0.55 * e.y);
  for (const double x : {0.5, 0.3, 0.7, 0.08, 0.92}) {
    for (const double z : {0.5, 0.3, 0.7, 0.08, 0.92}) places.push_back({box.lo.x + x * e.x, eye, box.lo.z + z * e.z});
  }
}

struct Best {
  Camera camera;
  Scout::Score score;
  /// `malus`: how much better an unusual view has to be.
  void consider(const Scout& scout, const Camera& candidate, double malus = 0) {
    Scout::Score s = scout.score(candidate);
    s.variety -= malus;
    if (s.total() > score.total() + 1e-9) *this = {candidate, s};
  }
};

Best bestInside(const Scout& scout, const std::vector<Vec3d>& places) {
  Best best;
  for (const Vec3d& eye : places) {
    for (int i = 0; i < 16; ++i) {
      const double yaw = kPiD * i / 8;
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
      const double yaw = kPiD * (i / 6.0 + 0.3), level = std::cos(elevation) * distance;
      const Vec3d eye = center + Vec3d{std::cos(yaw) * level, std::sin(elevation) * distance, std::sin(yaw) * level};
      best.consider(scout, lookAt(eye, center, kOutsideFov), 0.3 * std::abs(elevation - 0.35));
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
  std::vector<Vec3d> places;
  addStandingPlaces(scene, scout.box(), places);
  addStandingPlaces(scene, denseBox(scene), places);
  std::vector<Vec3d> enclosed;
  for (const Vec3d& eye : places) {
    if (scout.enclosure(eye) >= kEnclosed) enclosed.push_back(eye);
  }
  const Best inside = bestInside(scout, enclosed.empty() ? places : enclosed);
  const double enough = enclosed.empty() ? kSurrounded : kRoomy;
  return inside.score.filled > enough ? inside.camera : bestOutside(scout).camera;
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
