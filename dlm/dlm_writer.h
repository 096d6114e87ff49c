// Writes a .dlm folder: manifest.json, scene.glb, irradiance.exr, directional.exr, moments.exr (docs/dlm-format.md).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/image_file.h"
#include "dlm/light_maps.h"
#include "dlm/map_format.h"
#include "tracer/scene/gltf_writer.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct DlmFormat {
  MapFormat directional = MapFormat::half;  // the irradiance is always float32
  ExrCompression compression = ExrCompression::rle;
  double kMax = 32;  // of ldr8, see ldrScales()
};

/// Written aside and exchanged whole; what is at `folder` is replaced only if it is such a folder itself
/// (holdsLightMaps), else Error(failed). `provenance`: an object whose members go into the manifest as they are
/// (settings, ledger, content_hash, …); the manifest's own keys win over members of the same name. Error(outOfResource)
/// when the directional maps are more than one OpenEXR file of ours may hold (2^30 texels).
void writeDlm(const std::filesystem::path& folder, const Scene& scene, const AtlasUv& uv, const LightMaps& maps,
              const nlohmann::json& provenance, const DlmFormat& format = {});

/// True for a folder with a manifest.json of ours in it, of whatever version.
bool holdsLightMaps(const std::filesystem::path& folder);

}  // namespace lucarne
