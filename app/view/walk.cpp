#include "app/view/walk.h"

#include "dlm/dlm_reader.h"

namespace lucarne {

PlayReport walk(const std::filesystem::path& path, PlayOptions options) {
  const Dlm dlm = readDlm(path);
  options.title = "Lucarne: " + path.filename().string();
  options.photons = dlm.manifest.value("photons", 0.0);
  return play(dlm.scene, dlm.maps, options);
}

}  // namespace lucarne
