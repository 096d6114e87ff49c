#include "tracer/scene/gltf_document.h"

#include <algorithm>

#include "tracer/scene/glb_container.h"

namespace lucarne {
namespace {

Json& arrayOf(Json& json, const char* key) {
  Json& list = json[key];
  if (list.is_null()) list = Json::array();
  return list;
}

std::vector<std::uint32_t> unusedOf(const std::vector<std::uint8_t>& used) {
  std::vector<std::uint32_t> unused;
  for (std::uint32_t i = static_cast<std::uint32_t>(used.size()); i-- > 0;) {
    if (used[i] == 0) unused.push_back(i);
  }
  return unused;
}

}  // namespace

GltfDocument::GltfDocument(Json json, const GltfSource& source, const UsedReferences& used)
    : json_(std::move(json)), freeAccessors_(unusedOf(used.accessors)), freeViews_(unusedOf(used.views)) {
  // Views may overlap or repeat; equal ranges are stored once.
  std::map<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>, std::uint64_t> stored;
  Json& views = arrayOf(json_, "bufferViews");
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    if (used.views[i] == 0) continue;
    const Place place = source.place().in("bufferViews", i);
    const auto bytes = source.viewBytes(i);
    const auto range = std::tuple(requiredCount(views[i], "buffer", place), countOf(views[i], "byteOffset", 0, place),
                                  std::uint64_t{bytes.size()});
    const auto known = stored.find(range);
    const std::uint64_t offset = known != stored.end() ? known->second : append(bytes);
    stored.emplace(range, offset);
    views[i]["buffer"] = 0;
    views[i]["byteOffset"] = offset;
  }
}

std::uint64_t GltfDocument::append(std::span<const std::uint8_t> bytes) {
  bin_.resize((bin_.size() + 3) / 4 * 4);
  const std::uint64_t offset = bin_.size();
  if (bytes.size() > 0xffffffffu - offset) {
    throw Error(ExitCode::failed, "the scene takes more than the 4 GiB that a GLB file can hold");
  }
  bin_.insert(bin_.end(), bytes.begin(), bytes.end());
  return offset;
}

std::uint32_t GltfDocument::place(const char* key, std::vector<std::uint32_t>& freePlaces, Json object) {
  Json& list = arrayOf(json_, key);
  if (freePlaces.empty()) {
    list.push_back(std::move(object));
    return static_cast<std::uint32_t>(list.size() - 1);
  }
  const std::uint32_t index = freePlaces.back();
  freePlaces.pop_back();
  list[index] = std::move(object);
  return index;
}

std::uint32_t GltfDocument::addView(std::span<const std::uint8_t> bytes, std::uint32_t stride, std::uint32_t target) {
  Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
  view["byteOffset"] = append(bytes);
  if (stride != 0) view["byteStride"] = stride;
  if (target != 0) view["target"] = target;
  return place("bufferViews", freeViews_, std::move(view));
}

std::uint32_t GltfDocument::addAccessor(Json accessor) {
  return place("accessors", freeAccessors_, std::move(accessor));
}

std::uint32_t GltfDocument::zeroUvAccessor(std::uint64_t count) {
  const auto known = zeroUv_.find(count);
  if (known != zeroUv_.end()) return known->second;
  return zeroUv_[count] = addAccessor({{"componentType", 5126}, {"count", count}, {"type", "VEC2"}});
}

/// Free places at the end go; those in between must stay, so that the numbers after them do not change.
void GltfDocument::dropFreePlaces(const char* key, std::vector<std::uint32_t>& freePlaces, const Json& filler) {
  Json& list = arrayOf(json_, key);
  for (const std::uint32_t index : freePlaces) {  // decreasing
    if (index + 1 == list.size()) {
      list.erase(index);
    } else {
      list[index] = filler;
    }
  }
  freePlaces.clear();
  if (list.empty()) json_.erase(key);
}

std::vector<std::uint8_t> GltfDocument::finish() {
  dropFreePlaces("accessors", freeAccessors_, {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}});
  dropFreePlaces("bufferViews", freeViews_, {{"buffer", 0}, {"byteLength", 1}});
  Json buffer = Json::object();
  if (json_.contains("buffers") && !json_["buffers"].empty()) buffer = json_["buffers"][0];
  for (const char* key : {"uri", "extensions"}) buffer.erase(key);
  buffer["byteLength"] = bin_.size();
  json_["buffers"] = Json::array({buffer});
  if (bin_.empty()) json_.erase("buffers");
  return packGlb(json_.dump(), bin_);
}

}  // namespace lucarne
