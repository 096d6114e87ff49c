#include "player/play.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/files.h"
#include "base/huge_heap.h"
#include "base/image_file.h"
#include "base/log.h"
#include "base/units.h"
#include "dlm/dlm_reader.h"
#include "player/display_pass.h"
#include "player/eye_adaptation.h"
#include "player/gpu_timer.h"
#include "player/look_tools.h"
#include "player/overlay.h"
#include "player/read_back.h"
#include "player/render_scale.h"
#include "player/scene_switch.h"
#include "player/walk_control.h"
#include "player/window.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

constexpr float kStopPerKey = 0.5f;
constexpr double kNoteSeconds = 5;
constexpr double kMinimisedWait = 0.1, kLoadingWait = 1.0 / 30;  // seconds between frames with nothing to draw

double secondsBetween(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

class Session {
 public:
  Session(const std::filesystem::path& dlm, const PlayOptions& options, std::optional<WalkPath> path)
      : options_(options),
        path_(std::move(path)),
        window_(options.render.width, options.render.height, options.title),
        overlay_(window_.handle()),
        driver_(driverName()),
        timer_(!isSoftwareDriver(driver_)),
        scale_(options.renderScale > 0 ? std::clamp(options.renderScale, 0.1, 1.0) : 1, !(options.renderScale > 0) && !isBenchmark()),
        kind_(options.render.renderer),
        look_(options.look),
        next_(window_,
              {dlm, options.camera, options.render.format, options.render.lobe, kind_, look_.view, options.render.gpuMemory},
              options.watch) {
    if (isBenchmark()) window_.setVsync(false);
    benchmark_.pathFps = options.fps;
    next_.begin(kind_, look_);
  }

  PlayReport run() {
    try {
      drawFrames();
    } catch (const std::exception& error) {
      if (control_ && !options_.record.empty()) logWarning(std::string("ended by an error: ") + error.what());
      keepRecording();  // should this fail too, it is the later error that main tells
      throw;
    }
    keepRecording();
    throwOnComplaint(window_.messages(), "drawing");
    return finish();
  }

 private:
  bool isBenchmark() const { return !options_.benchmark.empty(); }

  void drawFrames() {
    Clock::time_point last = Clock::now();
    double step = 0;
    while (!window_.closing()) {
      window_.poll(window_.isMinimised() ? kMinimisedWait : shown_ || !next_.isLoading() ? 0 : kLoadingWait);
      if (options_.ended && options_.ended()) window_.close();
      handleKeys();
      followLoading();
      const WalkInput input = window_.takeWalk();
      if (control_) move(step, input);
      drawFrame(step);
      const Clock::time_point now = Clock::now();
      step = secondsBetween(last, now);
      last = now;
      noteSeconds_ -= step;
      countFrame(step, input.moving());
    }
  }

  void followLoading() {
    next_.step(kind_, look(), !shown_);
    if (next_.isWarm()) target(window_.framebufferSize());  // its memory, too, is new
    if (std::unique_ptr<ShownScene> scene = next_.take()) show(std::move(scene));
  }

  void show(std::unique_ptr<ShownScene> scene) {
    if (tools_) look_ = tools_->settings;
    tools_.reset();
    const bool first = !shown_;
    shown_ = std::move(scene);
    if (!first) releaseFreedMemory();
    takeUpLook();
    eye_ = {};  // other maps are exposed as they should be at once
    sinceLoaded_ = 0;
    if (control_) {
      control_->moveTo(shown_->walk);
      return;
    }
    control_ = std::make_unique<WalkControl>(shown_->walk, options_.fly);
    if (const std::string line = options_.remark ? options_.remark(shown_->dlm().scene, shown_->dlm().maps) : "";
        !line.empty())
      logInfo(line);
    const std::string note = options_.fly ? "" : control_->startNote();
    if (!note.empty()) logInfo(note);
    tell(note);
    if (path_) control_->replay(*path_);
    if (!options_.record.empty()) control_->record();
    benchmark_.loadSeconds = shown_->loadSeconds;
  }

  /// The tools and the sky of what was just loaded.
  void takeUpLook() {
    FrameRenderer& renderer = shown_->renderer;
    if (!shown_->fit.note.empty()) logWarning(shown_->fit.note);
    look_.view.psi = std::clamp(look_.view.psi, 0, std::max(0, shown_->dlm().maps.directionCount - 1));
    tools_ = std::make_unique<LookTools>(shown_->dlm().scene, shown_->dlm().maps, options_.sky, renderer.outputScale(), shown_->lightByDirection());
    tools_->settings = look_;
    if (!options_.sky.pixels.empty()) renderer.setSky(options_.sky);
  }

  LookSettings& look() { return tools_ ? tools_->settings : look_; }

  void move(double step, const WalkInput& input) {
    if (!isBenchmark()) return control_->advance(step, input);
    control_->seek(static_cast<double>(frame_) / options_.fps);
    if (frame_ + 1 >= frameCount(*path_, options_.fps)) window_.close();
  }

  void tell(const std::string& text) {
    note_ = text;
    noteSeconds_ = kNoteSeconds;
  }
  std::string note() const {
    if (next_.isBusy()) return next_.progress();
    return noteSeconds_ > 0 && !note_.empty() ? note_ : next_.failure();
  }

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
          look().stops += kStopPerKey;
          break;
        case WalkKey::darker:
          look().stops -= kStopPerKey;
          break;
        case WalkKey::autoExposure:
          look().stops = 0;
          look().exposureLocked = false;
          break;
        case WalkKey::help:
          help_ = !help_;
          break;
        case WalkKey::reload:
          if (!next_.isBusy()) next_.begin(kind_, look());
          break;
        default:
          pressForWalk(key);
          break;
      }
    }
  }

  void pressForWalk(WalkKey key) {
    if (!control_ || isBenchmark()) return;
    control_->press(key);
    if (key == WalkKey::fly) tell(control_->flying() ? "flying" : "walking");
  }

  /// The target for the window as it is now; made anew only when the size changes.
  const FrameTarget& target(Window::Size size) {
    const bool exact = scaleOf(look().view.kind) == ViewScale::number;  // may be above what 16 bits hold
    const int width = std::max(1, static_cast<int>(std::lround(size.width * scale_.scale())));
    const int height = std::max(1, static_cast<int>(std::lround(size.height * scale_.scale())));
    if (!target_ || target_->width != width || target_->height != height || targetIsExact_ != exact)
      target_ = std::make_unique<FrameTarget>(width, height, exact);
    targetIsExact_ = exact;
    return *target_;
  }

  /// The automatic exposure, unless it is held; another kind of picture is exposed as it should be at once.
  void adapt(const FrameTarget& frame, double step) {
    const ViewScale scale = scaleOf(look().view.kind);
    if (meteredView_ != look().view.kind) {
      eye_ = {};
      sinceLoaded_ = 0;
      meteredView_ = look().view.kind;
    }
    if (look().exposureLocked && scale == ViewScale::light && sinceLoaded_ > 0) return;
    eye_.follow(display_, frame, scale, sinceLoaded_++, step);
  }

  /// Draws the scene over the window; what there is to say of it.
  OverlayText drawScene(double step, Window::Size size) {
    const FrameTarget& frame = target(size);
    FrameRenderer& renderer = shown_->renderer;
    handleLookKeys(look(), shown_->dlm().maps.directionCount, window_.takePresses());
    const bool screenshot = std::exchange(look().screenshot, false);
    FrameView view{control_->camera()};
    view.view = look().view;
    timer_.begin();
    renderer.setLobe(look().lobe);
    renderer.draw(view, kind_, frame);
    timer_.end();
    adapt(frame, step);
    tools_->follow(view.camera, frame.width, frame.height);
    const bool light = scaleOf(look().view.kind) == ViewScale::light;
    const float exposure = light ? eye_.exposure() * std::exp2(look().stops) : eye_.exposure();
    display_.show(frame, tools_->style(exposure), size.width, size.height);
    if (screenshot) savePictures(frame, size);
    ++frame_;
    return overlayText(frame, step, exposure);
  }

  OverlayText overlayText(const FrameTarget& frame, double step, float exposure) const {
    OverlayText text;
    text.frameSeconds = smoothedStep_;
    text.lastFrameSeconds = step;
    text.gpuSeconds = timer_.seconds();
    text.renderer = kind_;
    text.stats = shown_->renderer.stats();
    text.photons = shown_->photons;
    text.width = frame.width;
    text.height = frame.height;
    text.renderScale = scale_.scale();
    text.ev100 =
        ev100OfExposure(static_cast<double>(exposure) * static_cast<double>(shown_->renderer.outputScale()));
    text.help = help_;
    text.truth = tools_->truthState();
    text.found = &tools_->inspection();
    return text;
  }

  void drawFrame(double step) {
    const Window::Size size = window_.framebufferSize();
    if (window_.isMinimised()) return;
    OverlayText text;
    if (shown_) {
      text = drawScene(step, size);
    } else {
      if (warmDisplay_ > 0) warmUpDisplay(size, --warmDisplay_);
      clear(size);
    }
    text.note = note();
    overlay_.draw(text, look());
    if (options_.frames > 0 && frame_ >= static_cast<std::uint64_t>(options_.frames)) window_.close();
    if (window_.closing() && shown_ && !options_.screenshot.empty()) saveWindow(options_.screenshot, size);
    window_.swap();
  }

  /// The last passes of a frame, compiled before there is one, one after the other; the window's first frame has enough to do.
  void warmUpDisplay(Window::Size size, int pass) {
    if (pass == 2) return;
    const FrameTarget small(17, 17, false);
    if (pass == 1) {
      display_.meter(small, ViewScale::light);
      return;
    }
    DisplayStyle style;
    style.smoothEdges = look().smoothEdges;
    display_.show(small, style, size.width, size.height);
  }

  static void clear(Window::Size size) {
    constexpr GLfloat kBlack[4] = {0, 0, 0, 1};
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.width, size.height);
    glClearBufferfv(GL_COLOR, 0, kBlack);
  }

  void countFrame(double step, bool moving) {
    if (frame_ <= 1 && benchmark_.shownSeconds == 0) {
      benchmark_.loadingSeconds.push_back(step);
      if (frame_ == 1) benchmark_.shownSeconds = secondsBetween(start_, Clock::now());
    }
    if (frame_ == 0) return;
    scale_.update(step, moving);
    smoothedStep_ = smoothedStep_ > 0 ? 0.9 * smoothedStep_ + 0.1 * step : step;
    seconds_ += step;
    if (!isBenchmark() || frame_ == 1) return;  // the first one waits for the shaders
    benchmark_.frameSeconds.push_back(step);
    if (timer_.seconds()) benchmark_.gpuSeconds.push_back(*timer_.seconds());
  }

  /// The window without its overlay, and the frame's values, in the folder that the program runs in.
  void savePictures(const FrameTarget& frame, Window::Size size) const {
    const std::string base = freePictureName(std::filesystem::current_path()).string();
    saveWindow(base + ".png", size);
    ImageRgb image = readBack(frame);
    if (scaleOf(tools_->settings.view.kind) == ViewScale::light) {
      for (Rgb& p : image.pixels) p = p / shown_->renderer.outputScale();
    }
    writeExrRgb(base + ".exr", image);
    logInfo("wrote " + base + ".png and .exr");
  }

  static void saveWindow(const std::filesystem::path& path, Window::Size size) {
    writePng(path, size.width, size.height, readBackBytes(0, size.width, size.height));
  }

  void keepRecording() {
    if (!control_ || options_.record.empty()) return;
    const WalkPath walk = control_->takeRecording();
    writeFileAtomically(options_.record, textOf(walk));
    logInfo("wrote " + options_.record.string() + ": a walk of " + formatDuration(walk.seconds()));
  }

  PlayReport finish() {
    PlayReport report{frame_, seconds_, {}};
    if (shown_) report.stats = shown_->renderer.stats();
    report.stats.driver = driver_;
    const bool interrupted = options_.ended && options_.ended();  // then the frames are not those of the whole path
    if (control_ && isBenchmark() && !interrupted) writeBenchmark(report.stats);
    return report;
  }

  void writeBenchmark(const RenderStats& stats) {
    benchmark_.width = target_->width;
    benchmark_.height = target_->height;
    benchmark_.options = options_.render;
    benchmark_.stats = stats;
    benchmark_.glBytes = stats.textureBytes + target_->bytes();
    writeFileAtomically(options_.benchmark, textOf(benchmark_));
  }

  const Clock::time_point start_ = Clock::now();
  const PlayOptions& options_;
  std::optional<WalkPath> path_;  // to be replayed
  Window window_;  // before all that needs its context
  DisplayPass display_;
  Overlay overlay_;
  std::string driver_;
  GpuTimer timer_;
  RenderScale scale_;
  RendererKind kind_;
  LookSettings look_;  // before and between scenes; else that of the tools
  std::unique_ptr<ShownScene> shown_;
  std::unique_ptr<LookTools> tools_;  // of shown_
  std::unique_ptr<WalkControl> control_;
  std::unique_ptr<FrameTarget> target_;
  EyeAdaptation eye_;
  std::uint64_t frame_ = 0, sinceLoaded_ = 0;
  double seconds_ = 0, smoothedStep_ = 0, noteSeconds_ = 0;
  ViewKind meteredView_ = ViewKind::full;
  bool targetIsExact_ = false, help_ = false;
  int warmDisplay_ = 3;  // calls of warmUpDisplay() to come
  std::string note_;
  Benchmark benchmark_;
  SceneSwitch next_;  // last: its loader ends before what it shares
};

}  // namespace

PlayReport play(const std::filesystem::path& dlm, const PlayOptions& options) {
  if (!options.benchmark.empty() && options.replay.empty())
    throw UsageError("--benchmark needs --replay F: the walk that is timed");
  shareOneHeap();  // the loader's thread makes the textures
  // What cannot be is told before a window opens.
  readManifest(dlm);
  std::optional<WalkPath> path;
  if (!options.replay.empty()) path = readWalkPath(options.replay);
  for (const auto& output : {options.record, options.benchmark, options.screenshot})
    if (!output.empty()) checkWritable(output);
  return Session(dlm, options, std::move(path)).run();
}

}  // namespace lucarne
