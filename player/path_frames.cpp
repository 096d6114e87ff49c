#include "player/path_frames.h"

#include <cmath>

#include "base/stopwatch.h"
#include "player/eye_adaptation.h"
#include "player/gl_context.h"
#include "player/gpu_timer.h"
#include "player/offscreen.h"
#include "player/overlay.h"
#include "player/screen_image.h"
#include "player/shown_scene.h"

namespace lucarne {
namespace {

class PathFrames {
 public:
  PathFrames(const Scene& scene, const MapSource& maps, const WalkPath& path, const PathFramesOptions& options)
      : options_(options),
        path_(path),
        frame_(scene.frame),
        renderer_(scene, maps, options.render.format, windowScale(scene, maps.maps), options.render.lobe),
        target_(options.render.width, options.render.height, false),
        screen_(options.render.width, options.render.height),
        driver_(driverName()),
        timer_(!isSoftwareDriver(driver_)) {
    look_.lobe = options.render.lobe;
    look_.view = options.render.view;
    if (options.overlay) overlay_.emplace(nullptr);
  }

  Benchmark draw(const PathFramesSink& sink) {
    const std::size_t count = frameCount(path_, options_.fps);
    for (std::size_t i = 0; i < count; ++i) {
      const bool wanted = sink.isWanted(i);
      // The exposure follows from all frames before; of those that are not wanted, from the metered ones.
      if (wanted || EyeAdaptation::meters(i)) drawScene(i);
      if (EyeAdaptation::meters(i)) eye_.meter(display_.meter(target_, scaleOf(options_.render.view.kind)));
      eye_.pass(1 / options_.fps);
      if (wanted) sink.take(i, finish());
    }
    return report();
  }

 private:
  void drawScene(std::size_t i) {
    watch_ = Stopwatch();
    timer_.begin();
    FrameView view{cameraOf(path_.at(static_cast<double>(i) / options_.fps), path_.yfov, frame_)};
    view.view = options_.render.view;
    renderer_.draw(view, options_.render.renderer, target_);
    timer_.end();
  }

  std::vector<std::uint8_t> finish() {
    DisplayStyle style;
    style.scale = scaleOf(options_.render.view.kind);
    style.exposure = eye_.exposure();
    style.smoothEdges = look_.smoothEdges;
    display_.show(target_, style, screen_.width, screen_.height, screen_.framebuffer.get());
    if (overlay_) {
      OverlayText text;
      text.frameSeconds = 1 / options_.fps;
      text.renderer = options_.render.renderer;
      text.stats = renderer_.stats();
      text.photons = options_.photons;
      text.width = screen_.width;
      text.height = screen_.height;
      text.lastFrameSeconds = text.frameSeconds;
      text.ev100 = ev100OfExposure(static_cast<double>(style.exposure) * static_cast<double>(renderer_.outputScale()));
      overlay_->draw(text, look_);
    }
    std::vector<std::uint8_t> pixels = screen_.read();
    if (drawn_++ > 0) {  // the first one waits for the shaders
      seconds_.push_back(watch_.seconds());
      if (timer_.seconds()) gpuSeconds_.push_back(*timer_.seconds());
    }
    return pixels;
  }

  Benchmark report() const {
    Benchmark b;
    b.frameSeconds = seconds_;
    b.gpuSeconds = gpuSeconds_;
    b.pathFps = options_.fps;
    b.width = target_.width;
    b.height = target_.height;
    b.options = options_.render;
    b.stats = renderer_.stats();
    b.stats.driver = driver_;
    b.glBytes = b.stats.textureBytes + target_.bytes();
    return b;
  }

  const PathFramesOptions& options_;
  const WalkPath& path_;
  LocalFrame frame_;
  FrameRenderer renderer_;
  DisplayPass display_;
  FrameTarget target_;
  ScreenImage screen_;
  std::string driver_;
  GpuTimer timer_;
  EyeAdaptation eye_;
  std::optional<Overlay> overlay_;
  LookSettings look_;
  Stopwatch watch_;
  std::size_t drawn_ = 0;
  std::vector<double> seconds_, gpuSeconds_;
};

}  // namespace

Benchmark drawPath(const Scene& scene, const MapSource& maps, const WalkPath& path, const PathFramesOptions& options,
                   const PathFramesSink& sink) {
  const Stopwatch watch;
  const HeadlessGl gl;
  checkPictureSize(options.render);
  PathFrames frames(scene, maps, path, options);
  glFinish();
  const double loadSeconds = watch.seconds();
  Benchmark benchmark = frames.draw(sink);
  benchmark.loadSeconds = loadSeconds;
  throwOnComplaint(gl.messages(), "drawing");
  return benchmark;
}

}  // namespace lucarne
