#include "tracer/scene/gltf_primitive_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tracer/scene/gltf_accessor.h"

namespace lucarne {
namespace {

constexpr std::uint32_t kVertices = 34962, kIndices = 34963;

template <class T>
std::span<const std::uint8_t> bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

/// Smallest and largest raw value of each component. Left out where one is not finite: JSON has no word for it.
void putBounds(Json& json, const Accessor& accessor, const std::vector<std::uint32_t>& vertices) {
  const bool isFloat = accessor.layout().componentType == 5126;
  Json lo = Json::array(), hi = Json::array();
  for (std::uint32_t c = 0; c < accessor.layout().components; ++c) {
    double least = accessor.rawValue(vertices[0], c), most = least;
    for (const std::uint32_t v : vertices) {
      least = std::min(least, accessor.rawValue(v, c));
      most = std::max(most, accessor.rawValue(v, c));
    }
    if (!std::isfinite(least) || !std::isfinite(most)) return;
    lo.push_back(isFloat ? Json(least) : Json(static_cast<std::int64_t>(least)));
    hi.push_back(isFloat ? Json(most) : Json(static_cast<std::int64_t>(most)));
  }
  json["min"] = lo;
  json["max"] = hi;
}

/// Copies the elements of an accessor for the split vertices: same type, packed, each padded to 4 bytes.
std::uint32_t gather(const GltfSource& source, std::uint32_t index, const std::string& semantic,
                     const SplitVertices& split, GltfDocument& document) {
  const Accessor accessor(source, index);
  const std::uint32_t size = accessor.layout().elementSize, stride = (size + 3) / 4 * 4;
  Json json = source.list("accessors")[index];
  for (const char* key : {"bufferView", "byteOffset", "sparse", "min", "max"}) json.erase(key);
  json["count"] = split.source.size();
  if (accessor.hasData()) {
    std::vector<std::uint8_t> bytes(split.source.size() * stride, 0);
    for (std::size_t i = 0; i < split.source.size(); ++i) {
      std::memcpy(bytes.data() + i * stride, accessor.element(split.source[i]), size);
    }
    json["bufferView"] = document.addView(bytes, stride == size ? 0 : stride, kVertices);
  }
  if (semantic == "POSITION") putBounds(json, accessor, split.source);
  return document.addAccessor(std::move(json));
}

Json gatherAll(const GltfSource& source, const Json& attributes, const SplitVertices& split, GltfDocument& document) {
  Json gathered = Json::object();
  for (const auto& [name, index] : attributes.items()) {
    if (name == "TEXCOORD_1" || name == "_CHART") continue;
    if (name == "TEXCOORD_0" && !Accessor(source, index.get<std::uint32_t>()).hasData())
      continue;  // put in again below
    gathered[name] = gather(source, index.get<std::uint32_t>(), name, split, document);
  }
  return gathered;
}

template <class T>
std::uint32_t addAttribute(const std::vector<T>& values, const char* type, GltfDocument& document) {
  return document.addAccessor({{"bufferView", document.addView(bytesOf(values), 0, kVertices)},
                               {"componentType", 5126},
                               {"count", values.size()},
                               {"type", type}});
}

/// 16 bits where they suffice; 65535 is not used, it restarts strips in some interfaces.
std::uint32_t addIndices(const SplitVertices& split, GltfDocument& document) {
  const bool isShort = split.source.size() <= 65535;
  std::vector<std::uint16_t> narrow;
  if (isShort) {
    for (const std::uint32_t i : split.indices) narrow.push_back(static_cast<std::uint16_t>(i));
  }
  const auto bytes = isShort ? bytesOf(narrow) : bytesOf(split.indices);
  return document.addAccessor({{"bufferView", document.addView(bytes, 0, kIndices)},
                               {"componentType", isShort ? 5123 : 5125},
                               {"count", split.indices.size()},
                               {"type", "SCALAR"}});
}

}  // namespace

void fillTexcoordGaps(Json& attributes, std::uint64_t vertexCount, GltfDocument& document) {
  std::uint64_t highest = 0;
  for (const auto& [name, index] : attributes.items()) {
    if (name.starts_with("TEXCOORD_") && name.size() < 14)
      highest = std::max<std::uint64_t>(highest, std::strtoul(name.c_str() + 9, nullptr, 10));
  }
  for (std::uint64_t set = 0; set < std::min<std::uint64_t>(highest, 16); ++set) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    if (!attributes.contains(name)) attributes[name] = document.zeroUvAccessor(vertexCount);
  }
}

void writePrimitive(const GltfSource& source, const Json& original, const SplitVertices& split, GltfDocument& document,
                    Json& primitive) {
  // Built aside: adding to the document may move its JSON.
  Json attributes = gatherAll(source, original["attributes"], split, document);
  attributes["TEXCOORD_1"] = addAttribute(split.uv, "VEC2", document);
  attributes["_CHART"] = addAttribute(split.chart, "SCALAR", document);
  fillTexcoordGaps(attributes, split.source.size(), document);
  primitive["attributes"] = std::move(attributes);
  primitive["indices"] = addIndices(split, document);
  primitive.erase("mode");
  if (!original.contains("targets")) return;
  Json targets = Json::array();
  for (const Json& target : original["targets"]) targets.push_back(gatherAll(source, target, split, document));
  primitive["targets"] = std::move(targets);
}

}  // namespace lucarne
