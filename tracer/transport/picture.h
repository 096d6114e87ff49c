// Pictures by the path tracer.
#pragma once

#include <cstdint>
#include <functional>

#include "base/image_file.h"
#include "tracer/transport/path_tracer.h"

namespace lucarne {

struct PictureOptions {
  int width = 1280, height = 720;
  std::uint32_t samples = 64;  // a pixel
  std::uint64_t seed = 0;
  int threads = 1;
};

/// Linear cd/m², box-filtered pixels. `progress(done)` is called now and then, from one thread at a time, with the
/// number of pixels done. The picture depends on neither threads nor order.
ImageRgb pathTracedPicture(const PhotonScene& scene, const Camera& camera, const PictureOptions& options,
                           const std::function<void(std::uint64_t)>& progress);

}  // namespace lucarne
