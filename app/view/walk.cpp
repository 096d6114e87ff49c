#include "app/view/walk.h"

namespace lucarne {

PlayReport walk(const std::filesystem::path& path, PlayOptions options) {
  options.title = "Lucarne: " + path.filename().string();
  return play(path, options);
}

}  // namespace lucarne
