#include "tracer/scene/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lucarne {
namespace {

/// `words` empty: read in full, or without any influence on light. Else "WORDS of N materials: FATE".
struct Extension {
  std::string_view name, words, fate;
};

constexpr std::string_view kIgnored = "ignored", kOpaque = "treated as opaque";
constexpr std::array kExtensions = std::to_array<Extension>({
    {"KHR_lights_punctual", "", ""},
    {"KHR_materials_emissive_strength", "", ""},
    {"KHR_materials_specular", "", ""},
    {"KHR_materials_ior", "", ""},
    {"KHR_materials_transmission", "", ""},
    {"KHR_materials_volume", "", ""},
    {"KHR_texture_transform", "", ""},
    {"KHR_mesh_quantization", "", ""},
    {"KHR_xmp_json_ld", "", ""},
    {"KHR_animation_pointer", "", ""},
    {"EXT_texture_webp", "", ""},  // the images that they bring are named one by one
    {"EXT_texture_avif", "", ""},
    {"KHR_texture_basisu", "", ""},
    {"MSFT_texture_dds", "", ""},
    {"KHR_draco_mesh_compression", "", ""},  // optional: the file has the plain data too
    {"EXT_meshopt_compression", "", ""},
    {"KHR_materials_diffuse_transmission", "diffuse transmission", kOpaque},
    {"KHR_materials_volume_scatter", "scattering volume", kIgnored},
    {"KHR_materials_dispersion", "dispersion", kIgnored},
    {"KHR_materials_clearcoat", "clear coat", kIgnored},
    {"KHR_materials_sheen", "sheen", kIgnored},
    {"KHR_materials_iridescence", "iridescence", kIgnored},
    {"KHR_materials_anisotropy", "anisotropy", kIgnored},
    {"KHR_materials_unlit", "unlit shading", "takes no light and gives none"},
    {"KHR_materials_pbrSpecularGlossiness", "specular-glossiness",
     "approximated by diffuse colour, specular colour and roughness"},
    {"KHR_materials_variants", "material variants", "the default ones are used"},
    {"EXT_mesh_gpu_instancing", "GPU instancing", "one instance stands for all"},
});

const Extension* findKnown(const std::string& name) {
  const auto it =
      std::find_if(kExtensions.begin(), kExtensions.end(), [&](const Extension& e) { return e.name == name; });
  return it == kExtensions.end() ? nullptr : &*it;
}

}  // namespace

void requireKnownExtension(const std::string& name, const Place& file) {
  if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression") {
    file.fail("its geometry is compressed with " + name + "; export it without compression");
  }
  if (findKnown(name) == nullptr)
    file.fail("requires the extension " + name + ", which is not supported; export it without");
}

std::string extensionLeftOut(const std::string& name, std::size_t count) {
  const Extension* known = findKnown(name);
  if (known == nullptr) return "extension " + name + ": ignored";
  if (known->words.empty()) return "";
  std::string text(known->words);
  if (name.starts_with("KHR_materials_") && count > 0) {
    text += " of " + std::to_string(count) + (count == 1 ? " material" : " materials");
  }
  return text + ": " + std::string(known->fate);
}

}  // namespace lucarne
