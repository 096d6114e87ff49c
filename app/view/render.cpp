#include "app/view/render.h"

#include <chrono>

#include "app/bake_environment.h"
#include "app/bake_scene.h"
#include "app/view/shown_otherwise.h"
#include "base/error.h"
#include "base/files.h"
#include "base/image_file.h"
#include "base/log.h"
#include "base/units.h"
#include "dlm/dlm_reader.h"
#include "player/camera_choice.h"
#include "player/offscreen.h"
#include "player/overlay_picture.h"
#include "player/shown_scene.h"
#include "player/tonemap.h"
#include "tracer/scene/gltf_reader.h"
#include "tracer/transport/picture.h"

namespace lucarne {

namespace {

/// Draws light maps; what the overlay tells of them into `text`.
ImageRgb drawn(const RenderJob& job, RenderReport& report, OverlayText& text) {
  OpenedDlm opened = openDlm(job.dlm, [](const std::string&, double) {});
  const Dlm& dlm = opened.dlm;
  const ImageRgb sky = loadSky(job.sky);
  report.otherwise = shownOtherwise(dlm.scene, dlm.maps);
  ImageRgb image = renderImage(opened, chooseCamera(dlm.scene, job.camera), job.options, &report.stats, &sky);
  text.renderer = job.options.renderer;
  text.frameSeconds = text.lastFrameSeconds = report.stats.frameSeconds;
  text.stats = report.stats;
  text.photons = photonsOf(dlm.manifest);
  text.width = image.width;
  text.height = image.height;
  text.renderScale = job.options.supersamples;
  return image;
}

/// Of a scene, or of the one that light maps were made of.
Scene sceneOf(const std::filesystem::path& path) { return readGltf(holdsLightMaps(path) ? path / "scene.glb" : path); }

ImageRgb pathTraced(const RenderJob& job, RenderStats& stats) {
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = sceneOf(job.dlm);
  const std::unique_ptr<Environment> sky = makeEnvironment(loadSky(job.sky), job.sky);
  const PhotonScene photonScene(scene, {}, sky.get());
  if (photonScene.emitters().empty()) logWarning(job.dlm.string() + " has no light: the picture will be black");
  PictureOptions options{job.options.width, job.options.height, job.samples, job.sky.seed, threadCount(job.sky)};
  const auto pixels = static_cast<std::uint64_t>(options.width) * static_cast<std::uint64_t>(options.height);
  double told = 0;
  const auto seconds = [&start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  ImageRgb image = pathTracedPicture(photonScene, chooseCamera(scene, job.camera), options, [&](std::uint64_t done) {
    if (seconds() < told + 30) return;
    told = seconds();
    logInfo(formatPercent(static_cast<double>(done) / static_cast<double>(pixels)) + " of the picture");
  });
  stats.driver = "the path tracer, " + std::to_string(job.samples) + " paths a pixel";
  stats.frameSeconds = seconds();
  return image;
}

}  // namespace

namespace {

void check(const RenderJob& job, bool png) {
  if (!png && job.output.extension() != ".exr") throw UsageError(job.output.string() + ": pictures are .exr or .png");
  const bool traced = job.options.renderer == RendererKind::pathtraced;
  if (traced && job.options.view.kind != ViewKind::full)
    throw UsageError("--view " + std::string(nameOf(job.options.view.kind)) +
                     " shows light maps; the path tracer has none");
  if (job.overlay && traced) throw UsageError("--overlay tells of light maps; the path tracer has none");
  if (job.overlay && !png) throw UsageError("--overlay is for .png: an .exr holds values alone");
}

void writeDisplayed(const RenderJob& job, const ImageRgb& image, OverlayText text, RenderReport& report) {
  DisplayedImage shown = displayImage(image, scaleOf(job.options.view.kind), job.display);
  if (job.overlay) {
    LookSettings look;
    look.curve = job.display.curve;
    look.view = job.options.view;
    look.lobe = job.options.lobe;
    look.exposureLocked = job.display.ev100.has_value();
    text.ev100 = shown.ev100;
    drawOverlayOver(shown.bytes, text, look);
  }
  writePng(job.output, image.width, image.height, shown.bytes);
  report.scale = std::move(shown.scale);
}

}  // namespace

RenderReport render(const RenderJob& job) {
  const bool png = job.output.extension() == ".png";
  check(job, png);
  checkWritable(job.output);
  RenderReport report;
  OverlayText text;
  const bool traced = job.options.renderer == RendererKind::pathtraced;
  const ImageRgb image = traced ? pathTraced(job, report.stats) : drawn(job, report, text);
  if (png) {
    writeDisplayed(job, image, text, report);
  } else {
    writeExrRgb(job.output, image);
  }
  return report;
}

}  // namespace lucarne
