#include "player/offscreen.h"

#include "base/error.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "player/frame_renderer.h"
#include "player/gl_context.h"
#include "player/map_fit.h"
#include "player/read_back.h"

namespace lucarne {

void checkPictureSize(const RenderOptions& options) {
  const int limit = textureLimits().size;
  if (options.width < 1 || options.height < 1 || options.width > limit || options.height > limit) {
    throw UsageError("--size " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " is not possible here; each side must be 1 to " + std::to_string(limit));
  }
}

namespace {

void checkView(const RenderOptions& options, const LightMaps& maps) {
  if (options.view.kind != ViewKind::direction || (options.view.psi >= 0 && options.view.psi < maps.directionCount))
    return;
  throw UsageError("--psi " + std::to_string(options.view.psi) + ": these light maps have the directions 0 to " +
                   std::to_string(maps.directionCount - 1));
}

/// The mean of pictures that are shifted by parts of a pixel, on a square grid.
ImageRgb supersampled(FrameRenderer& renderer, const FrameTarget& target, const Camera& camera,
                      const RenderOptions& options) {
  const int n = options.supersamples;
  ImageRgb sum{options.width, options.height, {}};
  for (int i = 0; i < n * n; ++i) {
    const auto shift = [&](int k) { return (k + 0.5) / n - 0.5; };
    renderer.draw({camera, shift(i % n), shift(i / n), options.view}, options.renderer, target);
    const ImageRgb image = readBack(target);
    if (n == 1) return image;
    sum.pixels.resize(image.pixels.size(), Rgb{});
    for (std::size_t p = 0; p < image.pixels.size(); ++p) sum.pixels[p] += image.pixels[p] / static_cast<float>(n * n);
  }
  return sum;
}

std::uint64_t memoryFor(const RenderOptions& options) { return options.gpuMemory > 0 ? options.gpuMemory : freeGpuMemory(); }

ImageRgb drawn(const HeadlessGl& gl, const Scene& scene, const MapSource& source, const Camera& camera,
               const RenderOptions& options, const Stopwatch& watch, RenderStats* stats, const ImageRgb* sky) {
  const MapFit fit = fitMaps(source.maps, options.format, memoryFor(options), textureLimits());
  if (!fit.note.empty()) logWarning(fit.note);
  FrameRenderer renderer(scene, fit.fewer ? MapSource(*fit.fewer) : source, fit.format, 1.f, options.lobe);
  if (sky != nullptr && !sky->pixels.empty()) renderer.setSky(*sky);
  const FrameTarget target(options.width, options.height, true);
  const double loaded = watch.seconds();
  ImageRgb image = supersampled(renderer, target, camera, options);
  throwOnComplaint(gl.messages(), "drawing");
  if (stats != nullptr) {
    *stats = renderer.stats();
    stats->driver = driverName();
    stats->loadSeconds = loaded;
    stats->frameSeconds = watch.seconds() - loaded;
  }
  return image;
}

}  // namespace

ImageRgb renderImage(const Scene& scene, const LightMaps& maps, const Camera& camera, const RenderOptions& options,
                     RenderStats* stats, const ImageRgb* sky) {
  const Stopwatch watch;
  const HeadlessGl gl;
  checkPictureSize(options);
  checkView(options, maps);
  return drawn(gl, scene, maps, camera, options, watch, stats, sky);
}

ImageRgb renderImage(OpenedDlm& opened, const Camera& camera, const RenderOptions& options, RenderStats* stats,
                     const ImageRgb* sky) {
  const Stopwatch watch;
  const HeadlessGl gl;
  checkPictureSize(options);
  checkView(options, opened.dlm.maps);
  const MapSource source = sourceOf(opened, options.format, memoryFor(options), textureLimits());
  return drawn(gl, opened.dlm.scene, source, camera, options, watch, stats, sky);
}

}  // namespace lucarne
