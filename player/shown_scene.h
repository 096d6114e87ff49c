// Light maps, ready to be drawn and walked in; read and sent to the GPU beside the window's own work.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "dlm/dlm_reader_steps.h"
#include "player/frame_renderer.h"
#include "player/inspector.h"
#include "player/map_fit.h"
#include "player/walk_control.h"

namespace lucarne {

struct ShownScene {
  std::unique_ptr<const OpenedDlm> opened;  // that the tools ask
  MapFit fit;
  FrameRenderer renderer;
  std::shared_ptr<const WalkScene> walk;
  double photons;  // of the bake; 0: not known
  double loadSeconds;

  const Dlm& dlm() const { return opened->dlm; }
  /// As Inspector wants it: from the GPU, unless the texels are in memory.
  LightByDirection lightByDirection() const;
};

/// Of the manifest's bake; 0: not known.
double photonsOf(const nlohmann::json& manifest);

/// Power of two that keeps lamps and lit surfaces within 16-bit floats.
float windowScale(const Scene& scene, const LightMaps& maps);

struct SceneRequest {
  std::filesystem::path dlm;
  std::string camera;  // as chooseCamera()
  LightMapFormat format = LightMapFormat::half;
  LobeKind lobe = LobeKind::cell;
  RendererKind renderer = RendererKind::singlepass;  // it and the view are made ready to be drawn
  View view{};
  std::uint64_t gpuMemory = 0;  // bytes that the light maps may take there; 0: what is free
};

/// Told before each step of loading; what it throws ends the loading.
using LoadObserver = std::function<void(const std::string& step, double share)>;

/// Reads and uploads; needs a current context. Errors of readDlm(), uploadMaps() and chooseCamera().
std::unique_ptr<ShownScene> loadScene(const SceneRequest& request, const LoadObserver& observe);

}  // namespace lucarne
