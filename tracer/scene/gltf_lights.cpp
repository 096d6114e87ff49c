#include "tracer/scene/gltf_lights.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace lucarne {
namespace {


/// Unit vector along the image of a unit axis, robust to scales that are tiny, huge or zero.
Vec3d worldAxis(const WorldNode& node, Vec3d axis) {
  const Vec3d scaled = normalize(balanced(node.world).vector(axis));
  if (dot(scaled, scaled) > 0.5) return scaled;
  const Vec3d rotated = normalize(node.rotation.vector(axis));
  return dot(rotated, rotated) > 0.5 ? rotated : axis;
}

std::string nodeName(const GltfSource& source, std::uint32_t node, const std::string& own) {
  const Place place = source.place().in("nodes", node);
  const std::string name = textOf(source.list("nodes")[node], "name", "", place);
  return name.empty() ? own : name;
}

void readCone(const Json& json, Light& light, const Place& place) {
  static const Json none = Json::object();
  const Json* spot = findObject(json, "spot", place);
  const Json& cone = spot == nullptr ? none : *spot;
  const double outer = std::clamp(numberOf(cone, "outerConeAngle", kPiD / 4, place.in("spot")), 0.0, kPiD / 2);
  const double inner = std::clamp(numberOf(cone, "innerConeAngle", 0, place.in("spot")), 0.0, outer);
  light.cosInner = cosPi(inner / kPiD);
  light.cosOuter = cosPi(outer / kPiD);
}

Light readLight(const Json& json, const Place& place) {
  Light light;
  light.name = textOf(json, "name", "", place);
  const std::string type = textOf(json, "type", "", place);
  if (type == "spot") {
    light.kind = LightKind::spot;
    readCone(json, light, place);
  } else if (type == "directional") {
    light.kind = LightKind::directional;
  } else if (type != "point") {
    place.in("type").fail("is none of point, spot and directional");
  }
  const auto color = numbersOf<3>(json, "color", {1, 1, 1}, place);
  const double intensity = numberOf(json, "intensity", 1, place);
  if (intensity < 0 || *std::min_element(color.begin(), color.end()) < 0)
    place.fail("has a negative intensity or color");
  light.intensity = Rgb(Rgbd{color[0], color[1], color[2]} * intensity);
  if (!(maxComponent(Rgbd{color[0], color[1], color[2]} * intensity) <= 1e30)) place.fail("has too large an intensity");
  return light;
}

Camera placedCamera(const WorldNode& node) {
  Camera camera;
  camera.position = node.world.t;
  camera.back = worldAxis(node, {0, 0, 1});
  // Scales may have bent the axes: up is kept in its plane with the view.
  const Vec3d right = cross(worldAxis(node, {0, 1, 0}), camera.back);
  camera.right = dot(right, right) > 1e-12 ? normalize(right) : Frame<double>(camera.back).s;
  camera.up = cross(camera.back, camera.right);
  return camera;
}

}  // namespace

std::vector<Light> readLights(const GltfSource& source, const std::vector<WorldNode>& nodes,
                              std::vector<std::string>& leftOut) {
  std::vector<Light> lights;
  bool ranges = false;
  for (const WorldNode& node : nodes) {
    const Json* use =
        findExtension(source.list("nodes")[node.node], "KHR_lights_punctual", source.place().in("nodes", node.node));
    if (use == nullptr) continue;
    const Json& list = source.json["extensions"]["KHR_lights_punctual"]["lights"];
    const std::uint32_t index = requiredIndex(*use, "light", list.size(), source.place().in("nodes", node.node));
    const Place place = source.place().in("lights", index);
    Light light = readLight(list[index], place);
    light.name = nodeName(source, node.node, light.name);
    light.position = node.world.t;
    light.direction = worldAxis(node, {0, 0, -1});
    ranges |= list[index].contains("range");
    lights.push_back(std::move(light));
  }
  if (ranges) leftOut.emplace_back("range of lights: ignored, light falls off with the square of the distance");
  return lights;
}

std::vector<Camera> readCameras(const GltfSource& source, const std::vector<WorldNode>& nodes,
                                std::vector<std::string>& leftOut) {
  std::vector<Camera> cameras;
  std::size_t orthographic = 0;
  const Json& list = source.list("cameras");
  for (const WorldNode& node : nodes) {
    const Place at = source.place().in("nodes", node.node);
    const std::uint32_t index = indexOf(source.list("nodes")[node.node], "camera", list.size(), at);
    if (index == kNone) continue;
    const Place place = source.place().in("cameras", index);
    if (textOf(list[index], "type", "", place) == "orthographic") {
      ++orthographic;
      continue;
    }
    const Json* perspective = findObject(list[index], "perspective", place);
    if (perspective == nullptr) place.fail("is neither perspective nor orthographic");
    Camera camera = placedCamera(node);
    camera.name = nodeName(source, node.node, textOf(list[index], "name", "", place));
    camera.yfov = numberOf(*perspective, "yfov", 0, place.in("perspective"));
    if (!(camera.yfov > 0 && camera.yfov < kPiD)) place.in("perspective").fail("has a yfov outside 0 .. pi");
    cameras.push_back(std::move(camera));
  }
  if (orthographic > 0) leftOut.emplace_back("orthographic cameras: left out");
  return cameras;
}

}  // namespace lucarne
