// Small glTF documents for tests: JSON and one buffer, as .gltf text with a data URI or as .glb.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tracer/scene/glb_container.h"
#include "tracer/scene/gltf_reader.h"
#include "tracer/scene/png_bytes.h"

namespace lucarne::test {

using Json = nlohmann::json;

inline std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

class GltfMaker {
 public:
  GltfMaker() { json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}}; }

  Json json;
  std::vector<std::uint8_t> bytes;

  template <class T>
  std::uint32_t view(const std::vector<T>& values) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    const std::size_t offset = bytes.size(), size = values.size() * sizeof(T);
    bytes.resize(offset + size);
    std::memcpy(bytes.data() + offset, values.data(), size);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    return static_cast<std::uint32_t>(json["bufferViews"].size() - 1);
  }

  template <class T>
  std::uint32_t accessor(const std::vector<T>& values, int componentType, const std::string& type) {
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    const std::uint32_t v = view(values);
    json["accessors"].push_back(
        {{"bufferView", v}, {"componentType", componentType}, {"count", values.size() / components}, {"type", type}});
    return static_cast<std::uint32_t>(json["accessors"].size() - 1);
  }
  std::uint32_t floats(const std::vector<float>& values, const std::string& type) {
    return accessor(values, 5126, type);
  }
  std::uint32_t shorts(const std::vector<std::uint16_t>& values) { return accessor(values, 5123, "SCALAR"); }

  /// A mesh of one primitive.
  std::uint32_t mesh(Json primitive) {
    json["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
    return static_cast<std::uint32_t>(json["meshes"].size() - 1);
  }
  /// A root node of the scene.
  std::uint32_t node(Json node) {
    json["nodes"].push_back(std::move(node));
    const std::size_t index = json["nodes"].size() - 1;
    json["scenes"][0]["nodes"].push_back(index);
    return static_cast<std::uint32_t>(index);
  }

  std::string text() const {
    Json whole = json;
    if (!bytes.empty()) {
      whole["buffers"] = Json::array(
          {{{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}});
    }
    return whole.dump();
  }
  std::vector<std::uint8_t> glb() const {
    Json whole = json;
    if (!bytes.empty()) whole["buffers"] = Json::array({{{"byteLength", bytes.size()}}});
    return packGlb(whole.dump(), bytes);
  }
  Scene read() const {
    const std::string t = text();
    return readGlb(std::span(reinterpret_cast<const std::uint8_t*>(t.data()), t.size()), "made.gltf");
  }
};

/// The unit square in the plane z = 0 in two indexed triangles, facing +z; node 0, mesh 0.
inline GltfMaker squareMaker() {
  GltfMaker maker;
  const std::uint32_t position = maker.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  const std::uint32_t indices = maker.shorts({0, 1, 2, 0, 2, 3});
  maker.mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  maker.node({{"mesh", 0}});
  return maker;
}

inline Json& squarePrimitive(GltfMaker& maker) { return maker.json["meshes"][0]["primitives"][0]; }

/// The square of squareMaker() with one material.
inline GltfMaker squareWith(const Json& material) {
  GltfMaker maker = squareMaker();
  maker.json["materials"] = Json::array({material});
  squarePrimitive(maker)["material"] = 0;
  return maker;
}

/// Adds a 2 × 1 image, "colours": red then green, with a texture, and returns the document.
inline GltfMaker withTexture(GltfMaker maker) {
  const std::vector<std::uint8_t> png = storedPng({2, 1, {255, 0, 0, 255, 0, 255, 0, 255}});
  maker.json["images"].push_back({{"uri", "data:image/png;base64," + base64(png)}, {"name", "colours"}});
  maker.json["textures"].push_back({{"source", 0}});
  return maker;
}

/// What the reader says against a document; empty when it takes it.
inline std::string complaint(const GltfMaker& maker) {
  try {
    maker.read();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace lucarne::test
