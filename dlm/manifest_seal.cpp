#include "dlm/manifest_seal.h"

#include <xxhash.h>

#include <array>
#include <cstdint>
#include <memory>

#include "base/error.h"
#include "base/input_file.h"

namespace lucarne {

namespace {

std::string hashOf(const InputFile& file) {
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), &XXH3_freeState);
  if (state == nullptr) throw Error(ExitCode::outOfResource, "out of memory while hashing " + file.path().string());
  XXH3_128bits_reset(state.get());
  std::vector<std::uint8_t> block(std::size_t{1} << 20);
  std::uint64_t offset = 0;
  for (std::size_t n = file.read(0, block.data(), block.size()); n > 0;
       n = file.read(offset, block.data(), block.size())) {
    XXH3_128bits_update(state.get(), block.data(), n);
    offset += n;
  }
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state.get()));
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
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
