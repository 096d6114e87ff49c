#include "app/view/player_pictures.h"

#include "player/camera_choice.h"
#include "player/offscreen.h"

namespace lucarne {

PlayerPictures playerPictures() {
  const auto draw = [](const Dlm& dlm, const Camera& camera, int width, int height, std::string& driver) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    RenderStats stats;
    ImageRgb image = renderImage(dlm.scene, dlm.maps, camera, options, &stats);
    driver = stats.driver;
    return image;
  };
  return {draw, automaticCamera};
}

}  // namespace lucarne
