#include "tracer/scene/gltf_embed.h"

#include <string_view>

namespace lucarne {
namespace {

std::string mimeTypeOf(const Json& image, std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG")) return "image/png";
  if (text.starts_with("\xff\xd8\xff")) return "image/jpeg";
  if (text.starts_with("RIFF")) return "image/webp";
  if (text.starts_with("\xabKTX")) return "image/ktx2";
  return image.contains("mimeType") ? image["mimeType"].get<std::string>() : "application/octet-stream";
}

}  // namespace

void embedImages(const GltfSource& source, GltfDocument& document) {
  for (std::uint32_t i = 0; i < source.list("images").size(); ++i) {
    Json& image = document.json()["images"][i];
    if (!image.contains("uri") || source.images[i].empty()) continue;
    image["mimeType"] = mimeTypeOf(image, source.images[i]);
    image.erase("uri");
    image["bufferView"] = document.addView(source.images[i], 0, 0);
  }
}

}  // namespace lucarne
