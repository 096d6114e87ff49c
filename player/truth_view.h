// The path-traced truth of one camera, made in the background while someone watches.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/image_file.h"
#include "tracer/scene/scene.h"

namespace lucarne {

class TruthView {
 public:
  /// `scene` must outlive this. `sky`: equirectangular, cd/m²; empty: black. Its thread has the lowest priority; it
  /// prepares itself at the first look().
  TruthView(const Scene& scene, ImageRgb sky);
  ~TruthView();
  TruthView(const TruthView&) = delete;
  TruthView& operator=(const TruthView&) = delete;

  /// What to work on. Another camera or size than before starts anew; the same goes on.
  void look(const Camera& camera, int width, int height);
  /// Rests until the next look().
  void rest();

  struct Progress {
    ImageRgb image;             // cd/m², top row first
    std::uint32_t samples = 0;  // paths a pixel that are in; 0: a coarse picture
  };
  /// The picture as it is now, if it is another than at the last call. Pictures of former cameras never come.
  std::optional<Progress> take();
  /// Why there will be no picture; empty while there may be one.
  std::string failure() const;

 private:
  struct Task {
    Camera camera;
    int width = 0, height = 0;
  };
  class Worker;
  void run();
  void work();

  const Scene& scene_;
  const ImageRgb sky_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Task> task_;                  // none: rests
  std::atomic<std::uint64_t> generation_{0};  // of the task; what is made for an older one is thrown away
  std::optional<Progress> news_;
  std::string failure_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace lucarne
