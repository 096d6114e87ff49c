#include "app/report_pictures.h"

#include <algorithm>

#include "app/bake_scene.h"
#include "app/check_input.h"
#include "app/sheet_exposure.h"
#include "app/sheet_maps.h"
#include "base/error.h"
#include "base/png_encode.h"
#include "base/stopwatch.h"
#include "base/units.h"
#include "tracer/transport/picture.h"

namespace lucarne {
namespace {

constexpr std::size_t kMostCameras = 8;
constexpr int kDrawnWidth = 640, kDrawnHeight = 360, kTracedWidth = 384, kTracedHeight = 216;
constexpr std::uint32_t kMostPaths = 64;

PagePicture shown(const ImageRgb& image, std::string title, std::string how) {
  std::vector<double> luminances;
  for (const Rgb& p : image.pixels) luminances.push_back(luminance(Rgbd(p)));
  const SheetExposure exposure(std::move(luminances));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const Rgb& p : image.pixels) {
    const DisplayColour c = exposure(Rgbd(p));
    bytes.insert(bytes.end(), c.begin(), c.end());
  }
  return {std::move(title), std::move(how), image.width, image.height, encodePng(image.width, image.height, bytes)};
}

/// One path a pixel tells how many fit into the time.
PagePicture traced(const PhotonScene& scene, const Camera& camera, const BakeOptions& options, double seconds,
                   std::string title) {
  PictureOptions picture{kTracedWidth, kTracedHeight, 1, options.seed, threadCount(options)};
  const auto silent = [](std::uint64_t) {};
  const Stopwatch clock;
  ImageRgb image = pathTracedPicture(scene, camera, picture, silent);
  const double fit = seconds / std::max(clock.seconds(), 1e-6) - 1;
  if (fit >= 2) {
    picture.samples = static_cast<std::uint32_t>(std::min(fit, static_cast<double>(kMostPaths)));
    image = pathTracedPicture(scene, camera, picture, silent);
  }
  return shown(image, std::move(title),
               "path traced without light maps, " + std::to_string(picture.samples) +
                   (picture.samples == 1 ? " path a pixel" : " paths a pixel"));
}

/// Tries the player until it fails once.
class CameraPainter {
 public:
  CameraPainter(const PictureInput& input, const PlayerPictures& player, ReportPictures& result)
      : input_(input), player_(player), result_(result), draws_(player.draw && input.dlm != nullptr) {}

  /// `get` takes the camera from a scene: the player's and the tracer's are kept in frames of their own.
  void paint(const std::string& title, double seconds, const std::function<Camera(const Scene&)>& get) {
    if (draws_ && draw(title, get)) return;
    if (input_.scene == nullptr) return;
    result_.cameras.push_back(traced(*input_.scene, get(input_.scene->scene()), input_.options, seconds, title));
  }
  bool possible() const { return draws_ || input_.scene != nullptr; }

 private:
  bool draw(const std::string& title, const std::function<Camera(const Scene&)>& get) {
    try {
      std::string driver;
      const ImageRgb image = player_.draw(*input_.dlm, get(input_.dlm->scene), kDrawnWidth, kDrawnHeight, driver);
      result_.cameras.push_back(shown(image, title, "drawn from the light maps by the player (" + driver + ")"));
      return true;
    } catch (const Error& error) {
      result_.notes.push_back(std::string("the player cannot draw here: ") + error.what());
      draws_ = false;
      return false;
    }
  }

  const PictureInput& input_;
  const PlayerPictures& player_;
  ReportPictures& result_;
  bool draws_;
};

const Scene& anyScene(const PictureInput& input) {
  return input.dlm != nullptr ? input.dlm->scene : input.scene->scene();
}

void addCameras(const PictureInput& input, const PlayerPictures& player, ReportPictures& result) {
  CameraPainter painter(input, player, result);
  if (!painter.possible()) {
    result.notes.emplace_back("no pictures of cameras: there is neither a player nor all light to trace with");
    return;
  }
  const std::vector<Camera>& cameras = anyScene(input).cameras;
  if (cameras.empty()) {
    if (!player.automaticCamera) {
      result.notes.emplace_back("the scene has no camera");
      return;
    }
    return painter.paint("a view found by itself: the scene has no camera", input.seconds, player.automaticCamera);
  }
  const std::size_t count = std::min(kMostCameras, cameras.size());
  const Stopwatch clock;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && clock.seconds() > input.seconds) {
      result.notes.push_back("cameras from number " + std::to_string(i) + " on are left out to save time");
      return;
    }
    const double share = std::max(0., input.seconds - clock.seconds()) / static_cast<double>(count - i);
    painter.paint("camera " + std::to_string(i) + " " + quotedName(cameras[i].name), share,
                  [i](const Scene& scene) { return scene.cameras.at(i); });
  }
  if (count < cameras.size())
    result.notes.push_back("of " + std::to_string(cameras.size()) + " cameras the first " + std::to_string(count));
}

PagePicture errorMap(const LightMaps& maps, bool back) {
  const SheetPanel panel = errorPanel(maps, back);
  Canvas canvas(kLargePanel, kPanelCaption + drawnLength(panel.grid, panel.grid.height(), kLargePanel),
                kSheetBackground);
  drawPanel(panel, 0, 0, kLargePanel, canvas);
  return {panel.title, "of each texel's irradiance, laid out as in the atlas; colours " + panel.legend, canvas.width(),
          canvas.height(), encodePng(canvas.width(), canvas.height(), canvas.bytes())};
}

}  // namespace

ReportPictures reportPictures(const PictureInput& input, const PlayerPictures& player) {
  ReportPictures result;
  addCameras(input, player, result);
  if (input.maps == nullptr) {
    result.notes.emplace_back("no error map: no light maps were made");
    return result;
  }
  for (const bool back : {false, true})
    if (anySide(*input.maps, back)) result.maps.push_back(errorMap(*input.maps, back));
  if (result.maps.empty()) result.notes.emplace_back("no error map: nothing is lit");
  return result;
}

}  // namespace lucarne
