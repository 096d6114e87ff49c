#include "tracer/transport/picture.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <mutex>

#include "base/float_mode.h"
#include "tracer/transport/pinhole.h"

namespace lucarne {
namespace {

Rgb pixelOf(const PathTracer& paths, const Pinhole& camera, int x, int y, std::uint64_t pixel,
            const PictureOptions& options) {
  Rgbd sum{};
  for (std::uint32_t s = 0; s < options.samples; ++s) {
    const PhotonSampler sampler(options.seed, pixel * options.samples + s);
    const auto u = sampler.floats(0, Stream::place);
    sum += Rgbd(paths.radiance(camera.through(x + static_cast<double>(u[0]), y + static_cast<double>(u[1])), sampler));
  }
  return Rgb(sum / static_cast<double>(options.samples));
}

}  // namespace

ImageRgb pathTracedPicture(const PhotonScene& scene, const Camera& camera, const PictureOptions& options,
                           const std::function<void(std::uint64_t)>& progress) {
  const PathTracer paths(scene);
  const Pinhole pinhole(camera, options.width, options.height);
  const auto width = static_cast<std::size_t>(options.width);
  ImageRgb image{options.width, options.height, {}};
  image.pixels.resize(width * static_cast<std::size_t>(options.height));
  std::atomic<std::uint64_t> done{0};
  std::mutex telling;
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads);
  arena.execute([&] {
    tbb::parallel_for(0, options.height, [&](int y) {
      const FlushDenormals mode;
      for (int x = 0; x < options.width; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        image.pixels[pixel] = pixelOf(paths, pinhole, x, y, pixel, options);
      }
      done += width;
      const std::lock_guard lock(telling);
      progress(done.load());
    });
  });
  return image;
}

}  // namespace lucarne
