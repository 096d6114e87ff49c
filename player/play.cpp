#include "player/play.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/image_file.h"
#include "player/camera_choice.h"
#include "player/display_pass.h"
#include "player/frame_renderer.h"
#include "player/gpu_timer.h"
#include "player/overlay.h"
#include "player/render_scale.h"
#include "player/texel_formats.h"
#include "player/walk_camera.h"
#include "player/window.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestStep = 0.1;  // seconds: a slow frame must not throw the walker through a wall
constexpr int kFramesPerMetering = 8;
constexpr double kAdaptationSeconds = 0.4;  // of the eye
constexpr float kStopPerKey = 0.5f;

/// The window's frames are 16-bit: a power of two that keeps lamps and lit surfaces within them.
float windowScale(const Scene& scene, const LightMaps& maps) {
  float largest = 0;
  for (const Material& m : scene.materials) largest = std::max(largest, maxComponent(m.emissive));
  for (const Rgb& E : maps.irradiance) largest = std::max(largest, maxComponent(E));  // E/π, and room for highlights
  return halfScale(largest);
}

class Session {
 public:
  Session(const Scene& scene, const LightMaps& maps, const PlayOptions& options)
      : options_(options),
        walker_(chooseCamera(scene, options.camera), walkSpeed(scene)),
        window_(options.render.width, options.render.height, options.title),
        renderer_(scene, maps, options.render.format, windowScale(scene, maps)),
        overlay_(window_.handle()),
        driver_(driverName()),
        timer_(!isSoftwareDriver(driver_)),
        scale_(std::clamp(options.renderScale, 0.1, 1.0)),
        kind_(options.render.renderer) {}

  PlayReport run() {
    const Clock::time_point start = Clock::now();
    Clock::time_point last = start;
    double step = 0;
    while (!window_.closing()) {
      window_.poll();
      handleKeys();
      const WalkInput input = window_.takeWalk();
      walker_.move(input, std::min(step, kLongestStep));
      drawFrame(step);
      const Clock::time_point now = Clock::now();
      step = std::chrono::duration<double>(now - last).count();
      last = now;
      scale_.update(step, input.moving());
      smoothedStep_ = smoothedStep_ > 0 ? 0.9 * smoothedStep_ + 0.1 * step : step;
    }
    throwOnComplaint(window_.messages(), "drawing");
    PlayReport report{frame_, std::chrono::duration<double>(last - start).count(), renderer_.stats()};
    report.stats.driver = driver_;
    return report;
  }

 private:
  void handleKeys() {
    for (const WalkKey key : window_.takeKeys()) {
      switch (key) {
        case WalkKey::quit:
          window_.close();
          break;
        case WalkKey::singlepass:
          kind_ = RendererKind::singlepass;
          break;
        case WalkKey::multipass:
          kind_ = RendererKind::multipass;
          break;
        case WalkKey::brighter:
          stops_ += kStopPerKey;
          break;
        case WalkKey::darker:
          stops_ -= kStopPerKey;
          break;
        case WalkKey::autoExposure:
          stops_ = 0;
          break;
        case WalkKey::help:
          help_ = !help_;
          break;
      }
    }
  }

  /// The target for the window as it is now; made anew only when the size changes.
  const FrameTarget& target(Window::Size size) {
    const int width = std::max(1, static_cast<int>(std::lround(size.width * scale_.scale())));
    const int height = std::max(1, static_cast<int>(std::lround(size.height * scale_.scale())));
    if (!target_ || target_->width != width || target_->height != height)
      target_ = std::make_unique<FrameTarget>(width, height, false);
    return *target_;
  }

  /// The automatic exposure follows the picture as an eye does, slowly and by ratios.
  void adapt(const FrameTarget& frame, double step) {
    if (frame_ % kFramesPerMetering == 0) metered_ = display_.meter(frame);
    const double share = frame_ == 0 ? 1 : 1 - std::exp(-step / kAdaptationSeconds);
    exposure_ = frame_ == 0 ? metered_ : exposure_ * static_cast<float>(std::pow(metered_ / exposure_, share));
  }

  void drawFrame(double step) {
    const Window::Size size = window_.framebufferSize();
    if (size.width < 1 || size.height < 1) return;  // minimised
    const FrameTarget& frame = target(size);
    timer_.begin();
    renderer_.draw({walker_.camera()}, kind_, frame);
    timer_.end();
    adapt(frame, step);
    display_.show(frame, exposure_ * std::exp2(stops_), size.width, size.height);
    overlay_.draw({smoothedStep_, timer_.seconds(), kind_, renderer_.stats(), options_.photons, frame.width,
                   frame.height, stops_, help_});
    ++frame_;
    if (options_.frames > 0 && frame_ >= static_cast<std::uint64_t>(options_.frames)) {
      window_.close();
    }
    if (window_.closing() && !options_.screenshot.empty()) saveScreenshot(size);
    window_.swap();
  }

  void saveScreenshot(Window::Size size) const {
    const auto row = static_cast<std::size_t>(size.width) * 3, height = static_cast<std::size_t>(size.height);
    std::vector<std::uint8_t> pixels(row * height), flipped;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    for (std::size_t y = height; y-- > 0;) {
      const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(y * row);
      flipped.insert(flipped.end(), from, from + static_cast<std::ptrdiff_t>(row));
    }
    writePng(options_.screenshot, size.width, size.height, flipped);
  }

  const PlayOptions& options_;
  WalkCamera walker_;
  Window window_;  // before all that needs its context
  FrameRenderer renderer_;
  DisplayPass display_;
  Overlay overlay_;
  std::string driver_;
  GpuTimer timer_;
  RenderScale scale_;
  RendererKind kind_;
  std::unique_ptr<FrameTarget> target_;
  std::uint64_t frame_ = 0;
  double smoothedStep_ = 0;
  float metered_ = 1, exposure_ = 1, stops_ = 0;
  bool help_ = false;
};

}  // namespace

PlayReport play(const Scene& scene, const LightMaps& maps, const PlayOptions& options) {
  return Session(scene, maps, options).run();
}

}  // namespace lucarne
