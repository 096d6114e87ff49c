#include "base/image_file.h"
#include "tracer/scene/gltf_materials.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kMaxDecodedBytes = std::uint64_t{4} << 30;  // of all images together

Image whiteImage() { return {1, 1, {255, 255, 255, 255}}; }

/// The image of a texture; kNone when it names none, or one that is not in the file.
std::vector<std::uint8_t> usedImages(const GltfSource& source, const GltfMaterials& materials) {
  std::vector<std::uint8_t> used(source.list("images").size(), 0);
  for (const Material& m : materials.materials) {
    for (const TextureUse* use : textureUses(m)) {
      if (!*use) continue;
      const std::uint32_t image = materials.textures[use->texture].image;
      if (image != kNone) used[image] = 1;
    }
  }
  return used;
}

std::string imageName(const GltfSource& source, std::uint32_t image) {
  const Json& json = source.list("images")[image];
  const Place place = source.place().in("images", image);
  std::string name = textOf(json, "name", "", place);
  if (name.empty()) name = textOf(json, "uri", "", place);
  if (name.empty() || name.starts_with("data:") || name.size() > 100) name = std::to_string(image);
  return name;
}

void dropNormalMaps(std::uint32_t image, const std::string& name, GltfMaterials& materials,
                    std::vector<std::string>& leftOut) {
  bool dropped = false;
  for (Material& m : materials.materials) {
    if (!m.normalTexture || materials.textures[m.normalTexture.texture].image != image) continue;
    m.normalTexture = {};
    dropped = true;
  }
  if (dropped) leftOut.emplace_back("normal maps of image " + name + ": ignored");
}

}  // namespace

std::vector<Image> readImages(const GltfSource& source, GltfMaterials& materials, std::vector<std::string>& leftOut) {
  const std::vector<std::uint8_t> used = usedImages(source, materials);
  std::vector<Image> images(used.size(), whiteImage());
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < images.size(); ++i) {
    if (used[i] == 0) continue;
    const std::string name = imageName(source, i);
    const std::span<const std::uint8_t> bytes = source.imageBytes(i);
    if (bytes.empty()) {
      leftOut.emplace_back("image " + name + ": cannot be found, white stands in");
      dropNormalMaps(i, name, materials, leftOut);
      continue;
    }
    try {
      DecodedImage decoded = decodeImage(bytes, source.place().in("images", i).text());
      total += decoded.rgba.size();
      if (total > kMaxDecodedBytes) throw InputError("too large");
      images[i] = {decoded.width, decoded.height, std::move(decoded.rgba)};
    } catch (const InputError&) {
      leftOut.emplace_back("image " + name + ": is not a PNG or JPEG that can be decoded, white stands in");
      dropNormalMaps(i, name, materials, leftOut);
    }
  }
  return images;
}

}  // namespace lucarne
