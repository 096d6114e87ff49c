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
#include "player/tonemap.h"
#include "tracer/scene/gltf_reader.h"
#include "tracer/transport/picture.h"

namespace lucarne {

namespace {

ImageRgb drawn(const RenderJob& job, RenderStats& stats, std::string& otherwise) {
  const Dlm dlm = readDlm(job.dlm);
  const ImageRgb sky = loadSky(job.sky);
  otherwise = shownOtherwise(dlm.scene, dlm.maps);
  return renderImage(dlm.scene, dlm.maps, chooseCamera(dlm.scene, job.camera), job.options, &stats, &sky);
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

RenderReport render(const RenderJob& job) {
  const std::string ending = job.output.extension().string();
  if (ending != ".exr" && ending != ".png") throw UsageError(job.output.string() + ": pictures are .exr or .png");
  checkWritable(job.output);
  const bool traced = job.options.renderer == RendererKind::pathtraced;
  if (traced && job.options.view.kind != ViewKind::full)
    throw UsageError("--view " + std::string(nameOf(job.options.view.kind)) +
                     " shows light maps; the path tracer has none");
  RenderReport report;
  const ImageRgb image = traced ? pathTraced(job, report.stats) : drawn(job, report.stats, report.otherwise);
  if (ending == ".exr") {
    writeExrRgb(job.output, image);
  } else {
    DisplayedImage shown = displayImage(image, scaleOf(job.options.view.kind), job.display);
    writePng(job.output, image.width, image.height, shown.bytes);
    report.scale = std::move(shown.scale);
  }
  return report;
}

}  // namespace lucarne
