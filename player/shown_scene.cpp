#include "player/shown_scene.h"

#include <algorithm>
#include <chrono>

#include "dlm/dlm_reader_steps.h"
#include "player/camera_choice.h"
#include "player/texel_formats.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kReading = 0.7, kSorting = 0.75, kCompiling = 0.95;  // shares of the whole

}  // namespace

double photonsOf(const nlohmann::json& manifest) {
  const auto found = manifest.find("photons");
  return found != manifest.end() && found->is_number() ? found->get<double>() : 0;
}

float windowScale(const Scene& scene, const LightMaps& maps) {
  float largest = 0;
  for (const Material& m : scene.materials) largest = std::max(largest, maxComponent(m.emissive));
  for (const Rgb& E : maps.irradiance) largest = std::max(largest, maxComponent(E));  // E/π, and room for highlights
  return halfScale(largest);
}

std::unique_ptr<ShownScene> loadScene(const SceneRequest& request, const LoadObserver& observe) {
  const Clock::time_point start = Clock::now();
  auto read = std::make_unique<const Dlm>(
      readDlm(request.dlm, [&](const std::string& step, double share) { observe(step, kReading * share); }));
  const Dlm& dlm = *read;
  observe("sorting the triangles", kReading);
  auto walk = std::make_shared<const WalkScene>(dlm.scene, chooseCamera(dlm.scene, request.camera));
  observe("sending the maps to the GPU", kSorting);
  MapFit fit = fitMaps(dlm.maps, request.format, request.gpuMemory > 0 ? request.gpuMemory : freeGpuMemory(), textureLimits());
  FrameRenderer renderer(dlm.scene, fit.fewer ? *fit.fewer : dlm.maps, fit.format, windowScale(dlm.scene, dlm.maps), request.lobe);
  fit.fewer.reset();  // they are on the GPU
  observe("compiling the shaders", kCompiling);
  renderer.warmUp(request.renderer, request.view);
  glFinish();
  const double photons = photonsOf(dlm.manifest);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return std::make_unique<ShownScene>(
      ShownScene{std::move(read), std::move(fit), std::move(renderer), std::move(walk), photons, seconds});
}

}  // namespace lucarne
