// What is about to be shown: light maps on their way from the file to the window's first picture of them.
//
// Reading and sending goes on beside the window (scene_loader.h). What the driver then compiles for the window alone it
// compiles a little a frame, so that no frame takes long.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "player/folder_watch.h"
#include "player/look_settings.h"
#include "player/scene_loader.h"
#include "player/shown_scene.h"
#include "player/window.h"

namespace lucarne {

class SceneSwitch {
 public:
  /// `watch`: begins by itself when the folder has been replaced. On the thread of the window, which must outlive this.
  SceneSwitch(Window& window, SceneRequest request, bool watch);

  /// Begins to load, made ready to be drawn like this. Not while busy.
  void begin(RendererKind renderer, const LookSettings& look);
  /// Loading, or loaded and not yet taken.
  bool isBusy() const { return loader_ || loaded_; }
  /// The window has nothing else to do meanwhile.
  bool isLoading() const { return loader_ != nullptr; }

  /// To be called once a frame. `first`: nothing is shown yet, so what cannot be loaded is thrown; else failure() tells.
  void step(RendererKind renderer, const LookSettings& look, bool first);
  /// All is compiled but what depends on the window's size: that is for the caller to make before the next frame.
  bool isWarm() const { return state_ == State::warm; }
  /// What is to be shown from now on, once, the frame after; else null.
  std::unique_ptr<ShownScene> take();

  /// What goes on, or what went wrong last; may be empty.
  std::string progress() const;
  const std::string& failure() const { return failure_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class State { cold, warm, ready };

  void takeLoaded(bool first);
  void warmUp(RendererKind renderer, const LookSettings& look);

  Window& window_;
  SceneRequest request_;
  bool isWatching_;
  FolderWatch watch_;
  Clock::time_point lookedAt_{};
  std::unique_ptr<ShownScene> loaded_;
  State state_ = State::cold;  // of loaded_
  std::size_t warmedUp_ = 0;   // steps of loaded_
  std::string failure_;
  std::unique_ptr<SceneLoader> loader_;  // last: it ends before what it shares
};

}  // namespace lucarne
