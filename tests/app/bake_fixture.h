// Bakes of small scenes in memory, and questions to them in world space.
#pragma once

#include <unistd.h>

#include <filesystem>

#include "app/bake_scene.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"
#include "dlm/probe.h"
#include "tests/support/scene_builder.h"
#include "tests/support/statistics.h"
#include "tracer/transport/guide_pilot.h"

namespace lucarne::test {

inline BakeOptions quickOptions(std::uint64_t photons, double texelsPerMetre) {
  BakeOptions o;
  o.kernel = {};
  o.photons = photons;
  o.texelsPerMetre = texelsPerMetre;
  return o;
}

/// A baked scene with everything that made it.
struct BakedScene {
  /// `sky`, if any, must outlive this.
  BakedScene(const Scene& scene_, const BakeOptions& options, const Environment* sky = nullptr)
      : scene(scene_), photonScene(scene, {}, sky), plan((learn(photonScene, options), makePlan(scene, options))),
        baked(bakeScene(photonScene, plan, options, [](const RunProgress&) { return true; })) {}

  static void learn(PhotonScene& scene, const BakeOptions& options) {
    if (options.guidedEmission && !scene.emitters().empty()) learnGuides(scene, {.seed = options.seed});
  }

  Scene scene;
  PhotonScene photonScene;
  BakePlan plan;
  Baked baked;
};

/// Every texel of every lit side with its covered area (m²).
template <class F>
void forEachTexel(const BakedScene& b, F&& f) {
  const double square = b.scene.frame.scale * b.scene.frame.scale;
  for (const SideMaps& side : b.baked.maps.sides) {
    if (!side.lit) continue;
    const std::uint64_t first = b.plan.layout.charts[side.chart].firstTexel;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      const double area = b.plan.layout.area[first + t] * square;
      if (area > 0) f(side, side.firstTexel + t, area);
    }
  }
}

/// The baked scene as the program sees it: written and read again, then probed.
class ProbedBake {
 public:
  explicit ProbedBake(const BakedScene& b, const std::string& name) : dlm_(roundTrip(b, name)), prober_(dlm_) {}
  ProbeAnswer at(Vec3d position, Vec3d normal) const { return prober_.probe(position, normal); }

 private:
  static Dlm roundTrip(const BakedScene& b, const std::string& name) {
    // Tests of one name run side by side, with other parameters.
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / (name + "-" + std::to_string(getpid()) + ".dlm");
    DlmFormat format;
    format.directional = MapFormat::float32;
    writeDlm(folder, b.scene, b.baked.uv, b.baked.maps, nlohmann::json::object(), format);
    Dlm dlm = readDlm(folder);
    std::filesystem::remove_all(folder);
    return dlm;
  }
  Dlm dlm_;
  Prober prober_;
};

}  // namespace lucarne::test
