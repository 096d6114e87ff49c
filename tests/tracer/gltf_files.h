// Where the real scenes lie, for tests that read them; they pass, less those cases, where the folder is absent.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace lucarne::test {

inline const std::filesystem::path kAssets = LUCARNE_SOURCE_DIR "/../shared/assets";

inline std::set<std::filesystem::path> gltfFilesBelow(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".glb" || extension == ".gltf") files.insert(entry.path());
  }
  return files;
}

}  // namespace lucarne::test
