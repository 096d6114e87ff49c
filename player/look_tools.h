// What the walkthrough offers beside the picture: settings of the look, probing, and the truth to compare with.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "player/display_pass.h"
#include "player/inspector.h"
#include "player/look_settings.h"
#include "player/truth_view.h"

namespace lucarne {

class LookTools {
 public:
  /// `scene` and `maps` must outlive this. `sky`: equirectangular, or empty. `outputScale`: target units per cd/m².
  /// `light`: as Inspector.
  LookTools(const Scene& scene, const LightMaps& maps, ImageRgb sky, float outputScale, LightByDirection light);

  LookSettings settings;

  /// Once a frame, before it is shown: does what is asked for at this camera, for a picture of this size.
  void follow(const Camera& camera, int width, int height);

  /// How the frame is to be shown. The truth is there as soon as there is something of it.
  DisplayStyle style(float exposure) const;
  const std::optional<Inspection>& inspection() const { return inspection_; }
  /// "64 paths a pixel"; empty while nothing is compared.
  std::string truthState() const;

 private:
  void compareWithTruth(const Camera& camera, int width, int height);
  void upload(const ImageRgb& image);

  const Scene& scene_;
  const LightMaps& maps_;
  LightByDirection light_;
  TruthView truth_;
  float outputScale_;
  std::unique_ptr<Inspector> inspector_;  // made at the first question
  std::optional<Inspection> inspection_;
  GlTexture truthImage_;
  int truthWidth_ = 0, truthHeight_ = 0;
  std::optional<Camera> truthCamera_;        // that it was asked for
  std::optional<std::uint32_t> truthPaths_;  // of the picture in truthImage_; none: it is of another camera
};

/// "lucarne-0001" and so on in a folder: the first for which there is neither .png nor .exr.
std::filesystem::path freePictureName(const std::filesystem::path& folder);

}  // namespace lucarne
