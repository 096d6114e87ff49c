// Who leads the camera: the walker's keys, the cameras of the file, or a recorded walk.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "player/walk_driver.h"
#include "player/walk_key.h"

namespace lucarne {

/// What is needed of a scene to walk in it.
struct WalkScene {
  WalkScene(const Scene& scene, const Camera& start_) : world(scene), cameras(scene.cameras), start(start_) {}

  WalkWorld world;
  std::vector<Camera> cameras;  // of the file
  Camera start;
};

class WalkControl {
 public:
  /// Starts at the scene's start, on a floor near it where there is one, unless `flying`.
  WalkControl(std::shared_ptr<const WalkScene> scene, bool flying);

  /// Keys that are not for the walker are left alone.
  void press(WalkKey key);
  /// Lets time go by. A walk that is being replayed ends with the path, or as soon as the walker is told to move.
  void advance(double seconds, const WalkInput& input);
  Camera camera() const;
  bool flying() const { return driver_.state().flying; }
  /// Why it flies though it was not asked to, for the user; empty where it walks.
  std::string startNote() const;

  void replay(WalkPath path);
  bool replaying() const { return path_.has_value(); }
  /// Goes to that second of the path that is replayed.
  void seek(double seconds) { pathSeconds_ = seconds; }
  void record() { driver_.record(); }
  WalkPath takeRecording();

  /// The same place in another scene, as far as one can stand there.
  void moveTo(std::shared_ptr<const WalkScene> scene);

 private:
  void changeFlying();
  void changeCamera(int by);
  void leavePath();

  std::shared_ptr<const WalkScene> scene_;
  Camera camera_;         // the last one gone to
  int cameraIndex_ = -1;  // of the list; −1: none yet
  WalkDriver driver_;
  double pace_ = 1;
  std::optional<WalkPath> path_;
  double pathSeconds_ = 0;
};

}  // namespace lucarne
