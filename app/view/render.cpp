#include "app/view/render.h"

#include "base/error.h"
#include "base/files.h"
#include "base/image_file.h"
#include "dlm/dlm_reader.h"
#include "player/camera_choice.h"
#include "player/offscreen.h"
#include "player/tonemap.h"

namespace lucarne {

RenderStats render(const RenderJob& job) {
  const std::string ending = job.output.extension().string();
  if (ending != ".exr" && ending != ".png") throw UsageError(job.output.string() + ": pictures are .exr or .png");
  checkWritable(job.output);
  const Dlm dlm = readDlm(job.dlm);
  RenderStats stats;
  const ImageRgb image = renderImage(dlm.scene, dlm.maps, chooseCamera(dlm.scene, job.camera), job.options, &stats);
  if (ending == ".exr") {
    writeExrRgb(job.output, image);
  } else {
    writePng(job.output, image.width, image.height, toDisplay(image, autoExposure(image)));
  }
  return stats;
}

}  // namespace lucarne
