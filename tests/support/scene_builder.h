// Small scenes made in memory, for tests. Triangles are flat; the local frame is computed as the reader computes it.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tracer/scene/local_frame.h"
#include "tracer/scene/scene.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne::test {

/// Perfect diffuser: no metal, no specular reflection at all.
inline Material diffuseMaterial(Rgb albedo, Rgb emissive = Rgb{0.f}) {
  Material m;
  m.name = "diffuse";
  m.baseColor = albedo;
  m.metallic = 0;
  m.roughness = 1;
  m.specular = 0;
  m.emissive = emissive;
  return m;
}

/// All points, boxes and lights in metres; build() moves them into the local frame.
class SceneBuilder {
 public:
  std::uint32_t addMaterial(Material material) {
    scene_.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }
  std::uint32_t addDiffuse(Rgb albedo, Rgb emissive = Rgb{0.f}) {
    return addMaterial(diffuseMaterial(albedo, emissive));
  }

  /// Counter-clockwise from the front.
  void addTriangle(Vec3d a, Vec3d b, Vec3d c, std::uint32_t material = 0) {
    const auto first = static_cast<std::uint32_t>(metres_.size());
    for (const Vec3d& p : {a, b, c}) metres_.push_back(p);
    scene_.triangles.push_back({{first, first + 1, first + 2}, material});
    uv_.insert(uv_.end(), 3, Vec2f{});
  }

  /// Two triangles a b c and a c d, counter-clockwise from the front; texture coordinates (0,0) (1,0) (1,1) (0,1).
  void addQuad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, std::uint32_t material = 0) {
    const auto first = static_cast<std::uint32_t>(metres_.size());
    for (const Vec3d& p : {a, b, c, d}) metres_.push_back(p);
    for (const Vec2f& uv : {Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{1, 1}, Vec2f{0, 1}}) uv_.push_back(uv);
    scene_.triangles.push_back({{first, first + 1, first + 2}, material});
    scene_.triangles.push_back({{first, first + 2, first + 3}, material});
  }

  /// Six quads, in the order −x +x −y +y −z +z. `inward`: the fronts look into the box (a room), else out of it.
  void addBox(Vec3d lo, Vec3d hi, std::uint32_t material = 0, bool inward = false) {
    const auto corner = [&](int i) { return Vec3d{i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}; };
    constexpr int outward[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : outward) {
      const std::array<Vec3d, 4> p{corner(q[0]), corner(q[1]), corner(q[2]), corner(q[3])};
      if (inward) {
        addQuad(p[3], p[2], p[1], p[0], material);
      } else {
        addQuad(p[0], p[1], p[2], p[3], material);
      }
    }
  }

  /// `light.position` in metres.
  void addLight(Light light) { scene_.lights.push_back(std::move(light)); }
  /// At `eye`, looking at `target`; metres. `up` must not be parallel to the view.
  void addCamera(Vec3d eye, Vec3d target, double yfov = 0.8, Vec3d up = {0, 1, 0}) {
    Camera camera;
    camera.name = "camera" + std::to_string(scene_.cameras.size());
    camera.position = eye;
    camera.back = normalize(eye - target);
    camera.right = normalize(cross(up, camera.back));
    camera.up = cross(camera.back, camera.right);
    camera.yfov = yfov;
    scene_.cameras.push_back(std::move(camera));
  }

  /// The scene so far. A scene without material gets one grey diffuser. All triangles are one instance (node 0, mesh
  /// 0).
  Scene build() const {
    Scene scene = scene_;
    if (scene.materials.empty()) scene.materials.push_back(diffuseMaterial(Rgb{0.5f}));
    Box box;
    for (const Vec3d& p : metres_) box.add(p);
    if (metres_.empty()) {
      for (const Light& light : scene.lights) box.add(light.position);
    }
    if (!box.empty()) scene.frame = localFrameOf(box);
    for (const Vec3d& p : metres_) scene.positions.push_back(localPosition(scene.frame, p));
    scene.uv0 = uv_;
    fillNormals(scene);
    for (Light& light : scene.lights) light.position = scene.frame.toLocal(light.position);
    for (Camera& camera : scene.cameras) camera.position = scene.frame.toLocal(camera.position);
    const auto count = static_cast<std::uint32_t>(scene.positions.size());
    for (std::uint32_t i = 0; i < count; ++i) scene.sourceVertex.push_back(i);
    scene.instances.push_back({0, 0, 0, 0, static_cast<std::uint32_t>(scene.triangles.size()), 0, count});
    markSkipped(scene);
    return scene;
  }

 private:
  /// The geometric normal at all corners; up for a triangle without area.
  static void fillNormals(Scene& scene) {
    scene.normals.assign(scene.positions.size(), Vec3f{0, 1, 0});
    scene.smooth.assign(scene.triangles.size(), 0);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const Vec3f n(normalize(scene.scaledNormal(t)));
      if (n == Vec3f{}) continue;
      for (const std::uint32_t v : scene.triangles[t].v) scene.normals[v] = n;
    }
  }

  Scene scene_;
  std::vector<Vec3d> metres_;
  std::vector<Vec2f> uv_;
};

}  // namespace lucarne::test
