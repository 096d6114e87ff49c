#include "tracer/scene/gltf_plain_source.h"

#include <cstring>

#include "base/math.h"
#include "tracer/scene/gltf_plain_materials.h"
#include "tracer/scene/png_bytes.h"

namespace lucarne {
namespace {

Json matrixJson(Vec3d x, Vec3d y, Vec3d z, Vec3d t) {
  return Json::array({x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, t.x, t.y, t.z, 1});
}

class PlainWriter {
 public:
  explicit PlainWriter(const Scene& scene) : scene_(scene), source_(std::make_shared<GltfSource>()) {}
  PlainSource write();

 private:
  void addNode(Json node);
  void addPrimitive(std::uint32_t first, std::uint32_t end);
  template <class T>
  std::uint32_t addAccessor(const std::vector<T>& values, std::uint32_t componentType, const char* type);
  void addLights();
  void addCameras();

  const Scene& scene_;
  std::shared_ptr<GltfSource> source_;
  std::vector<std::uint8_t> buffer_;
  PlainSource result_;
};

PlainSource PlainWriter::write() {
  source_->name = "scene";
  Json& json = source_->json;
  json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}};
  putMaterials(scene_, json);
  for (const Image& image : scene_.images) source_->images.push_back(storedPng(image));
  const Vec3d o = scene_.frame.origin;
  const double s = scene_.frame.scale;
  addNode({{"mesh", 0}, {"translation", {o.x, o.y, o.z}}, {"scale", {s, s, s}}});
  const auto count = static_cast<std::uint32_t>(scene_.triangles.size());
  for (std::uint32_t first = 0, end = 0; first < count; first = end) {
    const std::uint32_t material = scene_.triangles[first].material;
    while (end < count && scene_.triangles[end].material == material) ++end;
    addPrimitive(first, end);
  }
  addLights();
  addCameras();
  json["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  source_->buffers.push_back(std::move(buffer_));
  result_.source = source_;
  return std::move(result_);
}

void PlainWriter::addNode(Json node) {
  Json& nodes = source_->json["nodes"];
  nodes.push_back(std::move(node));
  source_->json["scenes"][0]["nodes"].push_back(nodes.size() - 1);
}

template <class T>
std::uint32_t PlainWriter::addAccessor(const std::vector<T>& values, std::uint32_t componentType, const char* type) {
  Json& json = source_->json;
  const std::size_t offset = buffer_.size(), size = values.size() * sizeof(T);
  buffer_.resize(offset + size);
  std::memcpy(buffer_.data() + offset, values.data(), size);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
  json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                               {"componentType", componentType},
                               {"count", values.size()},
                               {"type", type}});
  return static_cast<std::uint32_t>(json["accessors"].size() - 1);
}

/// Triangles first … end of one material, with the vertices that they use in the order of their first use.
void PlainWriter::addPrimitive(std::uint32_t first, std::uint32_t end) {
  std::vector<std::uint32_t> newVertex(scene_.positions.size(), kNone), indices;
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> uv0, uv1;
  std::vector<Vec4f> tangents;
  const std::uint32_t material = scene_.triangles[first].material;
  const bool hasTangents = scene_.materials[material].normalTexture && !scene_.tangents.empty();
  for (std::uint32_t t = first; t < end; ++t) {
    for (const std::uint32_t v : scene_.triangles[t].v) {
      if (newVertex[v] == kNone) {
        newVertex[v] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(scene_.positions[v]);
        normals.push_back(scene_.normals[v]);
        if (!scene_.uv0.empty()) uv0.push_back(scene_.uv0[v]);
        if (!scene_.uv1.empty()) uv1.push_back(scene_.uv1[v]);
        if (hasTangents) tangents.push_back(scene_.tangents[v]);
      }
      indices.push_back(newVertex[v]);
    }
  }
  Json primitive = {{"material", material}};
  primitive["indices"] = addAccessor(indices, 5125, "SCALAR");
  primitive["attributes"] = {{"POSITION", addAccessor(positions, 5126, "VEC3")},
                             {"NORMAL", addAccessor(normals, 5126, "VEC3")}};
  if (!uv0.empty()) primitive["attributes"]["TEXCOORD_0"] = addAccessor(uv0, 5126, "VEC2");
  if (!uv1.empty()) primitive["attributes"]["TEXCOORD_1"] = addAccessor(uv1, 5126, "VEC2");
  if (hasTangents) primitive["attributes"]["TANGENT"] = addAccessor(tangents, 5126, "VEC4");
  Json& primitives = source_->json["meshes"][0]["primitives"];
  primitives.push_back(std::move(primitive));
  PrimitiveInstance instance{};
  instance.primitive = static_cast<std::uint32_t>(primitives.size() - 1);
  instance.firstTriangle = first;
  instance.triangleCount = end - first;
  result_.instances.push_back(instance);
}

void PlainWriter::addLights() {
  if (scene_.lights.empty()) return;
  source_->json["extensionsUsed"].push_back("KHR_lights_punctual");
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Light& light = scene_.lights[i];
    const double intensity = maxComponent(light.intensity);
    const Rgbd color = intensity > 0 ? Rgbd(light.intensity) / intensity : Rgbd{1.0};
    Json json = {{"intensity", intensity}, {"color", {color.x, color.y, color.z}}};
    json["type"] = light.kind == LightKind::point ? "point" : light.kind == LightKind::spot ? "spot" : "directional";
    if (light.kind == LightKind::spot) {
      json["spot"] = {{"innerConeAngle", acos(light.cosInner)}, {"outerConeAngle", acos(light.cosOuter)}};
    }
    source_->json["extensions"]["KHR_lights_punctual"]["lights"].push_back(std::move(json));
    const Frame<double> f(-light.direction);
    Json node = {{"matrix", matrixJson(f.s, f.t, f.n, scene_.frame.toWorld(light.position))}};
    if (!light.name.empty()) node["name"] = light.name;
    node["extensions"]["KHR_lights_punctual"]["light"] = i;
    addNode(std::move(node));
  }
}

void PlainWriter::addCameras() {
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    const Camera& c = scene_.cameras[i];
    source_->json["cameras"].push_back({{"type", "perspective"}, {"perspective", {{"yfov", c.yfov}, {"znear", 0.01}}}});
    Json node = {{"camera", i}, {"matrix", matrixJson(c.right, c.up, c.back, scene_.frame.toWorld(c.position))}};
    if (!c.name.empty()) node["name"] = c.name;
    addNode(std::move(node));
  }
}

}  // namespace

PlainSource plainSource(const Scene& scene) { return PlainWriter(scene).write(); }

}  // namespace lucarne
