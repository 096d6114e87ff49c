#include "dlm/manifest_seal.h"

#include <cstdint>
#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "base/input_file.h"

namespace lucarne {

namespace {

std::string hashOf(const InputFile& file) {
  Hasher hasher;
  std::vector<std::uint8_t> block(std::size_t{1} << 20);
  std::uint64_t offset = 0;
  while (const std::size_t n = file.read(offset, block.data(), block.size())) {
    hasher.add(std::span<const std::uint8_t>(block.data(), n));
    offset += n;
  }
  return hasher.finish().hex();
}

}  // namespace

nlohmann::json sealFiles(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  nlohmann::json files = nlohmann::json::object();
  for (const std::string& name : names) {
    const InputFile file(folder / name);
    files[name] = {{"bytes", file.size()}, {"xxh3_128", hashOf(file)}};
  }
  return files;
}

void checkSeal(const nlohmann::json& manifest, const std::filesystem::path& folder, const std::string& name) {
  const auto files = manifest.find("files");
  if (files == manifest.end() || !files->is_object()) return;
  const auto seal = files->find(name);
  if (seal == files->end() || !seal->is_object()) return;
  const InputFile file(folder / name);
  const bool sameLength = !seal->contains("bytes") || (*seal)["bytes"] == file.size();
  if (sameLength && (!seal->contains("xxh3_128") || (*seal)["xxh3_128"] == hashOf(file))) return;
  throw InputError(
      file.path().string() + (sameLength ? " was altered" : " has another length") +
      " since it was written; copy or bake it again (or, if this was meant, remove its entry from \"files\" in " +
      "manifest.json)");
}

}  // namespace lucarne
