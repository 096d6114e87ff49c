#include "player/look_tools.h"

#include <cstdio>

namespace lucarne {

LookTools::LookTools(const Scene& scene, const LightMaps& maps, ImageRgb sky, float outputScale, LightByDirection light)
    : scene_(scene), maps_(maps), light_(std::move(light)), truth_(scene, std::move(sky)), outputScale_(outputScale) {}

void LookTools::follow(const Camera& camera, int width, int height) {
  if (settings.inspectAt) {
    if (!inspector_) inspector_ = std::make_unique<Inspector>(scene_, maps_, light_);
    const Vec2d at = *std::exchange(settings.inspectAt, std::nullopt);
    inspection_ = inspector_->inspect(camera, at.x, at.y, static_cast<double>(width) / height);
  }
  compareWithTruth(camera, width, height);
}

void LookTools::compareWithTruth(const Camera& camera, int width, int height) {
  const bool wanted = settings.compare && scaleOf(settings.view.kind) == ViewScale::light;
  if (!wanted) {
    if (truthCamera_) truth_.rest();
    truthCamera_.reset();
    truthPaths_.reset();
    return;
  }
  const auto moved = [&](const Camera& c) {
    return !(c.position == camera.position && c.back == camera.back && c.up == camera.up && c.yfov == camera.yfov);
  };
  if (!truthCamera_ || moved(*truthCamera_) || width != truthWidth_ || height != truthHeight_) truthPaths_.reset();
  truthCamera_ = camera;
  truthWidth_ = width;
  truthHeight_ = height;
  truth_.look(camera, width, height);
  if (const std::optional<TruthView::Progress> news = truth_.take()) {
    upload(news->image);
    truthPaths_ = news->samples;
  }
}

void LookTools::upload(const ImageRgb& image) {
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<Rgb> flipped;  // OpenGL counts rows from the bottom
  flipped.reserve(image.pixels.size());
  for (std::size_t y = static_cast<std::size_t>(image.height); y-- > 0;) {
    for (std::size_t x = 0; x < width; ++x) flipped.push_back(image.pixels[y * width + x] * outputScale_);
  }
  truthImage_ = makeTexture({GL_TEXTURE_2D, GL_RGB32F, 1, image.width, image.height, 1});
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(truthImage_.get(), 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT, flipped.data());
}

DisplayStyle LookTools::style(float exposure) const {
  DisplayStyle style;
  style.scale = scaleOf(settings.view.kind);
  style.curve = settings.curve;
  style.exposure = exposure;
  style.smoothEdges = settings.smoothEdges;
  style.other = truthPaths_ ? truthImage_.get() : 0;
  style.divider = settings.divider;
  return style;
}

std::string LookTools::truthState() const {
  if (!truthCamera_) return "";
  if (const std::string why = truth_.failure(); !why.empty()) return "no truth: " + why;
  if (!truthPaths_) return "the truth begins";
  return *truthPaths_ == 0 ? "coarse" : std::to_string(*truthPaths_) + " paths a pixel";
}

std::filesystem::path freePictureName(const std::filesystem::path& folder) {
  for (int i = 1;; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "lucarne-%04d", i);
    const std::filesystem::path base = folder / name;
    const auto there = [&](const char* ending) { return std::filesystem::exists(base.string() + ending); };
    if (!there(".png") && !there(".exr")) return base;
  }
}

}  // namespace lucarne
