#include "app/info.h"

#include <algorithm>

#include "app/ledger_json.h"
#include "app/merge_gaps.h"
#include "base/error.h"
#include "base/image_file.h"
#include "distributed/part_file.h"
#include "dlm/dlm_reader.h"
#include "tracer/scene/gltf_reader.h"
#include "tracer/scene/scene_summary.h"

namespace lucarne {
namespace {

std::string lowerExtension(const std::filesystem::path& path) {
  std::string e = path.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

nlohmann::json describeDlm(const std::filesystem::path& path) {
  nlohmann::json d = readManifest(path);
  // Long tables that only programs read.
  for (const char* key : {"charts", "sides"}) {
    if (!d.contains(key) || !d[key].is_object() || !d[key].contains("count")) continue;
    const nlohmann::json count = d[key]["count"];
    d[key] = count;
  }
  if (d.contains("directions") && d["directions"].is_object()) d["directions"].erase("list");
  d["kind"] = "light maps";
  return d;
}

nlohmann::json describePart(const std::filesystem::path& path) {
  const PartReader part(path);
  part.stream({});
  const PartHeader& h = part.header();
  nlohmann::json d = toJson(h);
  d.erase("tally_sets");  // long; what is in it follows in words
  d["kind"] = "part";
  d["photons"] = h.photons.count();
  d["photon_ranges"] = toJson(h.photons);
  if (h.direct) d["direct"] = directToJson(h);
  d["seed"] = h.identity.settings.value("seed", nlohmann::json());
  d["light_entries"] = h.lightEntries;
  d["texels"] = h.texels;
  if (h.momentEntries > 0) d["moment_entries"] = h.momentEntries;
  d["missing"] = toText(missingPhotons(h));
  d["seconds"] = static_cast<double>(h.microseconds) * 1e-6;
  d["tally_bytes"] = h.tallyBytes();
  d["file_bytes"] = std::filesystem::file_size(path);
  d.update(ledgerToJson(h.ledger, h.identity.emittedFlux));
  return d;
}

nlohmann::json describeImage(const ImageRgb& image) {
  Rgbd sum{};
  float peak = 0;
  std::uint64_t odd = 0;
  for (const Rgb& p : image.pixels) {
    if (!isFinite(p)) {
      ++odd;
      continue;
    }
    sum += Rgbd(p);
    peak = std::max(peak, maxComponent(p));
  }
  const double n = std::max<double>(1, static_cast<double>(image.pixels.size() - odd));
  return {{"kind", "image"},       {"width", image.width}, {"height", image.height},
          {"mean", {sum.x / n, sum.y / n, sum.z / n}}, {"peak", peak}, {"non_finite_pixels", odd}};
}

void append(const nlohmann::json& value, const std::string& key, int depth, std::string& text) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  const bool list = value.is_array() && !value.empty() && (value[0].is_object() || value[0].is_string());
  if (value.is_object()) {
    if (!key.empty()) text += indent + key + ":\n";
    for (const auto& [k, v] : value.items()) append(v, k, key.empty() ? depth : depth + 1, text);
  } else if (list) {
    text += indent + key + ":\n";
    for (const auto& v : value) {
      text += indent + "  - " + (v.is_string() ? v.get<std::string>() : v.dump()) + "\n";
    }
  } else {
    text += indent + key + ": " + (value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
  }
}

}  // namespace

nlohmann::json describe(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  nlohmann::json d;
  if (std::filesystem::is_directory(path)) {
    d = describeDlm(path);
  } else if (extension == ".glb" || extension == ".gltf") {
    d = summarize(readGltf(path));
    d["kind"] = "scene";
  } else if (isPart(path)) {
    d = describePart(path);
  } else if (extension == ".exr") {
    d = describeImage(readExrRgb(path));
  } else if (extension == ".hdr") {
    d = describeImage(readHdr(path));
  } else if (!std::filesystem::exists(path)) {
    throw InputError(path.string() + ": no such file or folder");
  } else if (extension == ".part") {
    d = describePart(path);  // says what is wrong with it
  } else {
    throw InputError(path.string() + ": not a .dlm folder, a .part, a .glb or .gltf scene, or an .exr or .hdr image");
  }
  d["path"] = path.string();
  return d;
}

std::string toText(const nlohmann::json& description) {
  std::string text;
  append(description, "", 0, text);
  return text;
}

}  // namespace lucarne
