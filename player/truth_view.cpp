#include "player/truth_view.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/float_mode.h"
#include "tracer/optics/environment.h"
#include "tracer/transport/path_tracer.h"
#include "tracer/transport/pinhole.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCoarse[] = {8, 4};  // pixels wide and high: the first pictures, one path a block
constexpr std::chrono::milliseconds kTellEvery{300};
constexpr std::uint64_t kPathsKept = 1u << 20;  // numbers apart between pixels
constexpr int kLowestPriority = 19;

bool same(const Camera& a, const Camera& b) {
  return a.position == b.position && a.right == b.right && a.up == b.up && a.back == b.back && a.yfov == b.yfov;
}

}  // namespace

/// Works on one task until it is overtaken.
class TruthView::Worker {
 public:
  Worker(TruthView& view, const PhotonScene& scene, const Task& task, std::uint64_t generation)
      : view_(view),
        paths_(scene),
        pinhole_(task.camera, task.width, task.height),
        width_(task.width),
        height_(task.height),
        generation_(generation),
        shown_{task.width, task.height, {}},
        sums_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
    shown_.pixels.resize(sums_.size());
  }

  void work() {
    const FlushDenormals mode;
    for (const int block : kCoarse) {
      if (!coarse(block)) return;
    }
    for (std::uint32_t sample = 0; sample < kPathsKept - 1; ++sample) {
      if (!pass(sample)) return;
      if (!tell(sample + 1)) return;
    }
  }

 private:
  bool overtaken() const { return view_.generation_.load() != generation_; }

  Rgb path(int x, int y, std::uint64_t number) const {
    const std::uint64_t pixel =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width_) + static_cast<std::uint64_t>(x);
    const PhotonSampler sampler(std::uint64_t{0}, pixel * kPathsKept + number);
    const auto u = sampler.floats(0, Stream::place);
    return paths_.radiance(pinhole_.through(x + static_cast<double>(u[0]), y + static_cast<double>(u[1])), sampler);
  }

  /// One path in the middle of each block of pixels; not counted. False when overtaken, here and below.
  bool coarse(int block) {
    for (int y = 0; y < height_; y += block) {
      if (overtaken()) return false;
      for (int x = 0; x < width_; x += block) {
        const int right = std::min(x + block, width_), bottom = std::min(y + block, height_);
        const Rgb light = path((x + right) / 2, (y + bottom) / 2, kPathsKept - 1);
        for (int v = y; v < bottom; ++v) {
          for (int u = x; u < right; ++u) shown_.pixels[indexOf(u, v)] = light;
        }
      }
    }
    return tell(0);
  }

  bool pass(std::uint32_t sample) {
    for (int y = 0; y < height_; ++y) {
      if (overtaken()) return false;
      for (int x = 0; x < width_; ++x) {
        const std::size_t i = indexOf(x, y);
        sums_[i] += Rgbd(path(x, y, sample));
        shown_.pixels[i] = Rgb(sums_[i] / (sample + 1.0));
      }
      if (Clock::now() > told_ + kTellEvery && !tell(sample)) return false;
    }
    return true;
  }

  bool tell(std::uint32_t samples) {
    const std::lock_guard lock(view_.mutex_);
    if (overtaken()) return false;
    view_.news_ = Progress{shown_, samples};
    told_ = Clock::now();
    return true;
  }

  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  TruthView& view_;
  PathTracer paths_;
  Pinhole pinhole_;
  int width_, height_;
  std::uint64_t generation_;
  ImageRgb shown_;
  std::vector<Rgbd> sums_;
  Clock::time_point told_ = Clock::now();
};

TruthView::TruthView(const Scene& scene, ImageRgb sky) : scene_(scene), sky_(std::move(sky)) {}

TruthView::~TruthView() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    ++generation_;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void TruthView::look(const Camera& camera, int width, int height) {
  {
    const std::lock_guard lock(mutex_);
    if (task_ && same(task_->camera, camera) && task_->width == width && task_->height == height) return;
    task_ = Task{camera, width, height};
    news_.reset();
    ++generation_;
  }
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  wake_.notify_all();
}

void TruthView::rest() {
  const std::lock_guard lock(mutex_);
  task_.reset();
  news_.reset();
  ++generation_;
}

std::optional<TruthView::Progress> TruthView::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, std::nullopt);
}

void TruthView::run() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLowestPriority);  // Linux: of this thread alone
  try {
    work();
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    failure_ = error.what();
  }
}

std::string TruthView::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void TruthView::work() {
  std::unique_ptr<Environment> environment;
  if (!sky_.pixels.empty()) environment = std::make_unique<Environment>(sky_, "the sky");
  const PhotonScene scene(scene_, {}, environment.get());
  std::uint64_t done = 0;
  while (true) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return ending_ || (task_ && generation_.load() != done); });
    if (ending_) return;
    const Task task = *task_;
    done = generation_.load();
    lock.unlock();
    Worker(*this, scene, task, done).work();
  }
}

}  // namespace lucarne
