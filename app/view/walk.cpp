#include "app/view/walk.h"

#include "app/bake_environment.h"
#include "app/view/shown_otherwise.h"

namespace lucarne {

PlayReport walk(const std::filesystem::path& path, PlayOptions options, const BakeOptions& sky) {
  options.title = "Lucarne: " + path.filename().string();
  options.sky = loadSky(sky);
  options.look.lobe = options.render.lobe;
  options.look.view = options.render.view;
  options.remark = shownOtherwise;
  return play(path, options);
}

}  // namespace lucarne
