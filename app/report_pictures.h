// Pictures for the page of a report: what the cameras see, and where the light maps are noisy.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bake_options.h"
#include "base/image_file.h"
#include "dlm/dlm_reader.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

/// What the layers with OpenGL lend to those without. Either may be empty: not in this program.
struct PlayerPictures {
  /// Linear cd/m²; names what drew it. Error where there is no OpenGL.
  std::function<ImageRgb(const Dlm&, const Camera&, int width, int height, std::string& driver)> draw;
  /// A view of a scene that has no camera.
  std::function<Camera(const Scene&)> automaticCamera;
};

struct PagePicture {
  std::string title, how;  // how it was made
  int width = 0, height = 0;
  std::vector<std::uint8_t> png;
};

struct ReportPictures {
  std::vector<PagePicture> cameras, maps;
  std::vector<std::string> notes;  // what is not there, and why
};

struct PictureInput {
  const BakeOptions& options;  // threads and seed
  const PhotonScene* scene;    // for the path tracer; null: it has no sky to trace with
  const Dlm* dlm;              // for the player; null: no light maps were written
  const LightMaps* maps;       // null: none were made
  double seconds = 20;         // that pictures of cameras may take in all, about
};

/// Of at most eight cameras, drawn by the player, or traced where that cannot be: in the time there is, with as many
/// paths a pixel as fit. The error map of fronts and, where lit, of backs.
ReportPictures reportPictures(const PictureInput& input, const PlayerPictures& player);

}  // namespace lucarne
