#include "tracer/scene/gltf_source.h"

#include <optional>

#include "base/files.h"
#include "tracer/scene/glb_container.h"
#include "tracer/scene/gltf_accessor.h"
#include "tracer/scene/gltf_uri.h"
#include "tracer/scene/gltf_validate.h"

namespace lucarne {
namespace {

using Folder = std::optional<std::filesystem::path>;
constexpr std::uint64_t kMaxBytes = std::uint64_t{4} << 30;  // of all buffers together, and of all images

std::vector<std::uint8_t> externalBytes(const std::string& uri, const Folder& folder, std::uint64_t limit,
                                        const Place& place) {
  if (isDataUri(uri)) return decodeDataUri(uri, place);
  const std::filesystem::path path = confinedPath(folder.value_or(""), uri, place);
  if (!folder) place.fail("refers to another file, " + uri + "; pack all into one .glb");
  return readFile(path, limit);
}

/// Bytes of one buffer, cut to its byteLength.
std::vector<std::uint8_t> bufferBytes(const Json& buffer, std::size_t index, const GlbChunks& chunks,
                                      const Folder& folder, const Place& place) {
  const std::uint64_t length = requiredCount(buffer, "byteLength", place);
  std::vector<std::uint8_t> bytes;
  if (findMember(buffer, "uri") != nullptr) {
    bytes = externalBytes(textOf(buffer, "uri", "", place), folder, kMaxBytes, place.in("uri"));
  } else {
    if (index != 0 || !chunks.hasBin) place.fail("has no uri and the file no binary chunk for it");
    bytes.assign(chunks.bin.begin(), chunks.bin.end());
  }
  if (bytes.size() < length) {
    place.fail("has " + std::to_string(bytes.size()) + " bytes of the " + std::to_string(length) + " that it declares");
  }
  bytes.resize(length);
  return bytes;
}

void loadBuffers(GltfSource& source, const GlbChunks& chunks, const Folder& folder) {
  const Json& buffers = source.list("buffers");
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const Place place = source.place().in("buffers", i);
    total += std::min(requiredCount(buffers[i], "byteLength", place), kMaxBytes + 1);
    if (total > kMaxBytes) place.fail("makes the buffers larger than 4 GiB together");
    source.buffers.push_back(bufferBytes(buffers[i], i, chunks, folder, place));
  }
}

/// An image that is not there is not fatal (white stands in), but one outside the folder is refused.
void loadImages(GltfSource& source, const Folder& folder) {
  const Json& images = source.list("images");
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    source.images.emplace_back();
    if (findMember(images[i], "uri") == nullptr) continue;
    const Place place = source.place().in("images", i).in("uri");
    const std::string uri = textOf(images[i], "uri", "", place);
    if (!isDataUri(uri)) confinedPath("", uri, place);
    try {
      source.images.back() = externalBytes(uri, folder, kMaxBytes - total, place);
    } catch (const InputError&) {
      continue;
    }
    total += source.images.back().size();
  }
}

std::shared_ptr<const GltfSource> load(std::span<const std::uint8_t> bytes, const std::string& name,
                                       const Folder& folder) {
  auto source = std::make_shared<GltfSource>();
  source->name = name;
  const Place place = source->place();
  GlbChunks chunks;
  if (isGlb(bytes)) {
    chunks = parseGlb(bytes, place);
  } else {
    chunks.json = std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (bytes.empty()) place.fail("is empty");
  }
  source->json = parseGltfJson(chunks.json, place);
  validateGltf(source->json, place);
  loadBuffers(*source, chunks, folder);
  validateSparseIndices(*source);
  loadImages(*source, folder);
  return source;
}

}  // namespace

const Json& GltfSource::list(const char* key) const {
  static const Json none = Json::array();
  const Json* member = findMember(json, key);
  return member == nullptr ? none : *member;
}

std::span<const std::uint8_t> GltfSource::viewBytes(std::uint32_t view) const {
  const Json& v = list("bufferViews")[view];
  const Place where = place().in("bufferViews", view);
  const std::vector<std::uint8_t>& buffer = buffers[requiredIndex(v, "buffer", buffers.size(), where)];
  return std::span(buffer).subspan(countOf(v, "byteOffset", 0, where), requiredCount(v, "byteLength", where));
}

std::span<const std::uint8_t> GltfSource::imageBytes(std::uint32_t image) const {
  const Json& views = list("bufferViews");
  const std::uint32_t view = indexOf(list("images")[image], "bufferView", views.size(), place().in("images", image));
  return view == kNone ? std::span<const std::uint8_t>(images[image]) : viewBytes(view);
}

std::shared_ptr<const GltfSource> loadGltfSource(const std::filesystem::path& path) {
  return load(readFile(path), path.string(), path.parent_path());
}

std::shared_ptr<const GltfSource> loadGltfSource(std::span<const std::uint8_t> bytes, const std::string& name) {
  return load(bytes, name, std::nullopt);
}

}  // namespace lucarne
