#include "player/offscreen.h"

#include <chrono>

#include "base/error.h"
#include "player/frame_renderer.h"
#include "player/gl_context.h"
#include "player/read_back.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

void checkPictureSize(const RenderOptions& options) {
  const int limit = textureLimits().size;
  if (options.width < 1 || options.height < 1 || options.width > limit || options.height > limit) {
    throw UsageError("--size " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " is not possible here; each side must be 1 to " + std::to_string(limit));
  }
}

ImageRgb renderImage(const Scene& scene, const LightMaps& maps, const Camera& camera, const RenderOptions& options,
                     RenderStats* stats) {
  const Clock::time_point start = Clock::now();
  const HeadlessGl gl;
  checkPictureSize(options);
  FrameRenderer renderer(scene, maps, options.format, 1.f, options.lobe);
  const FrameTarget target(options.width, options.height, true);
  const double loaded = secondsSince(start);
  renderer.draw({camera}, options.renderer, target);
  ImageRgb image = readBack(target);
  throwOnComplaint(gl.messages(), "drawing");
  if (stats != nullptr) {
    *stats = renderer.stats();
    stats->driver = driverName();
    stats->loadSeconds = loaded;
    stats->frameSeconds = secondsSince(start) - loaded;
  }
  return image;
}

}  // namespace lucarne
