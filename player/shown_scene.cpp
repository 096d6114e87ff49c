#include "player/shown_scene.h"

#include <algorithm>
#include <chrono>

#include "player/camera_choice.h"
#include "player/stored_light.h"
#include "player/texel_formats.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSending = 0.95;  // share of the whole: when all is read and sent

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

LightByDirection ShownScene::lightByDirection() const {
  if (!opened->directional) return {};
  return [this](std::uint32_t side, Vec2d st) { return storedLight(renderer.maps(), dlm().maps, side, st); };
}

std::unique_ptr<ShownScene> loadScene(const SceneRequest& request, const LoadObserver& observe) {
  const Clock::time_point start = Clock::now();
  auto opened = std::make_unique<OpenedDlm>(
      openDlm(request.dlm, [&](const std::string& step, double share) { observe(step, kSending * share); }));
  const Dlm& dlm = opened->dlm;
  const double opening = kSending * opened->share;
  observe("sorting the triangles", opening);
  auto walk = std::make_shared<const WalkScene>(dlm.scene, chooseCamera(dlm.scene, request.camera));
  const std::string sending = "reading the directional maps";
  observe(sending, opening);
  const std::uint64_t memory = request.gpuMemory > 0 ? request.gpuMemory : freeGpuMemory();
  MapSource source = sourceOf(*opened, request.format, memory, textureLimits());
  source.progress = [&](double share) { observe(sending, opening + (kSending - opening) * share); };
  MapFit fit = fitMaps(dlm.maps, request.format, memory, textureLimits());
  FrameRenderer renderer(dlm.scene, fit.fewer ? MapSource(*fit.fewer) : source, fit.format, windowScale(dlm.scene, dlm.maps),
                         request.lobe);
  fit.fewer.reset();  // they are on the GPU
  observe("compiling the shaders", kSending);
  renderer.warmUpBeside(request.renderer, request.view);
  glFinish();
  const double photons = photonsOf(dlm.manifest);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return std::make_unique<ShownScene>(
      ShownScene{std::move(opened), std::move(fit), std::move(renderer), std::move(walk), photons, seconds});
}

}  // namespace lucarne
