// Constant light through the whole program: traced, resolved, written, read, drawn. Metals are white in the bake, so
// that what a furnace of radiance 1 shows of them, and they of each other, is 1 from everywhere; pictures are then made
// with other coats in the same constant light.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "app/bake_scene.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"
#include "dlm/probe.h"
#include "player/cell_tables.h"
#include "player/offscreen.h"
#include "tests/player/gl_available.h"
#include "tests/support/smooth_sphere.h"
#include "tests/support/statistics.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne::baked_furnace_test {
namespace {

constexpr double kRadius = 0.65, kPlate = 0.8;  // metres: of the sphere about the origin; x of the plate
constexpr double kDensity = 18;
constexpr int kSize = 41;
constexpr RendererKind kRenderers[] = {RendererKind::singlepass, RendererKind::multipass};  // by camera

Material coated(float exponent, Rgb color, float metallic) {
  Material m;
  m.baseColor = color;
  m.metallic = metallic;
  m.roughness = roughnessFromPhong(exponent);
  m.doubleSided = true;
  return m;
}

/// Black walls of radiance 1, a smooth sphere and a flat plate. Cameras: on the sphere, on the plate aslant.
Scene whiteFurnace(float exponent) {
  test::SceneBuilder s;
  const auto ball = s.addMaterial(coated(exponent, Rgb(1.f), 1));
  const auto plate = s.addMaterial(coated(exponent, Rgb(1.f), 1));
  s.addBox({-0.75, -0.75, -0.75}, {1, 0.75, 0.75}, s.addDiffuse(Rgb(0.f), Rgb(1.f)), true);
  test::addSphere(s, {}, kRadius, ball, 16);
  s.addQuad({kPlate, -0.6, 0.6}, {kPlate, -0.6, -0.6}, {kPlate, 0.6, -0.6}, {kPlate, 0.6, 0.6}, plate);
  s.addCamera({-0.72, 0.7, 0.7}, {}, 1.1);
  s.addCamera({0.25, 0.7, -0.7}, {kPlate, 0, 0}, 0.5);
  Scene scene = s.build();
  test::smoothen(scene, ball, {});
  return scene;
}

Dlm bake(const Scene& scene, int directions, DirectionFilter filter, std::uint64_t photons) {
  BakeOptions o;
  o.kernel = {};
  o.photons = photons;
  o.texelsPerMetre = kDensity;
  o.directions = directions;
  o.directionFilter = filter;
  const PhotonScene photonScene(scene);
  const BakePlan plan = makePlan(scene, o);
  const Baked baked = bakeScene(photonScene, plan, o, [](const RunProgress&) { return true; });
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("white_furnace" + std::to_string(directions) + nameOf(filter) + ".dlm");
  writeDlm(folder, scene, baked.uv, baked.maps, nlohmann::json::object());
  Dlm dlm = readDlm(folder);
  std::filesystem::remove_all(folder);
  return dlm;
}

struct Seen {
  Vec3d position, n, toEye;  // metres; unit
};

/// What the middle of a pixel shows of the sphere or the plate, from their formulas.
std::optional<Seen> seenAt(const Scene& scene, const Camera& camera, int x, int y) {
  const double t = std::tan(camera.yfov / 2);
  const Vec3d eye = scene.frame.toWorld(camera.position);
  const double u = (2 * (x + 0.5) / kSize - 1) * t, v = (1 - 2 * (y + 0.5) / kSize) * t;
  const Vec3d d = normalize(camera.right * u + camera.up * v - camera.back);
  const double along = -dot(eye, d), rest = along * along - dot(eye, eye) + kRadius * kRadius;
  if (rest > 0 && along > 0) {
    const Vec3d p = eye + d * (along - std::sqrt(rest));
    return Seen{p, normalize(p), -d};
  }
  const Vec3d p = eye + d * ((kPlate - eye.x) / d.x);
  if (d.x > 0 && std::max(std::abs(p.y), std::abs(p.z)) < 0.58) return Seen{p, {-1, 0, 0}, -d};
  return std::nullopt;
}

/// What is asked of one pixel: its place, what was estimated there, and how the noise of the maps shows.
struct Question {
  std::size_t pixel;
  bool sphere;
  float cosine;
  Seen seen;
  double relativeError;  // of E
};

/// On the sphere a texel holds the mean light of many normals, off their middle where a chart's edge cuts the kernel,
/// while a pixel has one normal: pixels are asked where the kernel is whole and not at grazing angles.
class Gallery {
 public:
  explicit Gallery(const Dlm& dlm) : dlm_(dlm), prober_(dlm) {
    for (const Camera& camera : dlm.scene.cameras) {
      questions_.emplace_back();
      for (int i = 0; i < kSize * kSize; ++i) ask(camera, i);
    }
  }
  const std::vector<Question>& of(std::size_t camera) const { return questions_[camera]; }

 private:
  void ask(const Camera& camera, int i) {
    const auto seen = seenAt(dlm_.scene, camera, i % kSize, i / kSize);
    if (!seen) return;
    const double cosine = dot(seen->n, seen->toEye);
    const bool sphere = seen->n.x > -1;
    if (cosine < (sphere ? 0.5 : 0.2) || (sphere && !amidItsChart(*seen))) return;
    const ProbeAnswer a = prober_.probe(seen->position, seen->n);
    ASSERT_TRUE(a.onSurface);
    questions_.back().push_back(
        {static_cast<std::size_t>(i), sphere, static_cast<float>(cosine), *seen, a.relativeError});
  }
  bool amidItsChart(const Seen& seen) const {
    const Frame<double> frame(seen.n);
    const std::uint32_t chart = prober_.probe(seen.position, seen.n).chart;
    for (int k = 0; k < 8; ++k) {
      const double turn = std::numbers::pi / 4 * k, texels = 2 / kDensity;
      const Vec3d side = seen.position + frame.toWorld({std::cos(turn) * texels, std::sin(turn) * texels, 0});
      const Vec3d p = normalize(side) * kRadius;
      if (prober_.probe(p, normalize(side)).chart != chart) return false;
    }
    return true;
  }

  const Dlm& dlm_;
  Prober prober_;
  std::vector<std::vector<Question>> questions_;
};

/// Standard error of the highlight over that of E. Counts fall into cells independently, so that the variance of B is
/// B·E·relativeError², of ΣBw/ΣCw with B = L·C and E = π·L thus π·ΣCw²/(ΣCw)² times that of E, relative to L.
/// (Of shared light it is less.)
double noiseOf(const DirectionSet& set, const Seen& seen, float exponent) {
  const DirectionFilter filter = set.triangles() != nullptr ? DirectionFilter::linear : DirectionFilter::nearest;
  const float sharpness = lobeSharpness(alphaFromPhong(exponent), set.count(), filter);
  const Vec3f mirror = mirrorDirection(Vec3f(seen.n), Vec3f(seen.toEye));
  double sum = 0, squares = 0;
  for (int psi = 0; psi < set.count(); ++psi) {
    const LobeCell cell = lobeCell(set, psi, seen.n);
    const double w = static_cast<double>(lobeWeight(sharpness, dot(mirror, cell.direction)));
    sum += static_cast<double>(cell.cosIntegral) * w;
    squares += static_cast<double>(cell.cosIntegral) * w * w;
  }
  return std::sqrt(std::numbers::pi * squares) / sum;
}

struct Result {
  double worst = 0;  // largest (|seen/expected − 1| − 2 %) in standard errors
  double mean = 0;   // of seen/expected − 1
  double noise = 0;  // root mean square of the standard errors
};

Result judge(const ImageRgb& image, const std::vector<Question>& questions, const Material& material,
             const DirectionSet& set, float exponent) {
  const Bsdf bsdf = makeBsdf(material, factorsOf(material));
  Result r;
  for (const Question& q : questions) {
    const Rgb expected = Coat(bsdf).albedo(q.cosine).total;
    const double se = q.relativeError * noiseOf(set, q.seen, exponent);
    for (int c = 0; c < 3; ++c) {
      const double off = static_cast<double>(image.pixels[q.pixel][c] / expected[c]) - 1;
      r.worst = std::max(r.worst, (std::abs(off) - 0.02) / se);
      r.mean += off / (3 * static_cast<double>(questions.size()));
    }
    r.noise += se * se / static_cast<double>(questions.size());
  }
  r.noise = std::sqrt(r.noise);
  return r;
}

struct Furnace {
  int directions;
  DirectionFilter filter;
};
class BakedFurnace : public test::GlTest, public testing::WithParamInterface<Furnace> {};

TEST_P(BakedFurnace, ShowsEveryCoatByItsAlbedo) {
  const auto [directions, filter] = GetParam();
  Dlm dlm = bake(whiteFurnace(directions == 14 ? 1.f : directions == 64 ? 10.f : 100.f), directions, filter, 10'000'000);
  const DirectionSet set(directions, filter);
  const Gallery gallery(dlm);
  ASSERT_EQ(dlm.scene.cameras.size(), 2u);
  for (const float exponent : {1.f, 10.f, 100.f}) {
    for (const Material& material : {coated(exponent, {0.9f, 0.6f, 0.3f}, 1), coated(exponent, Rgb(0.f), 0)}) {
      dlm.scene.materials[0] = dlm.scene.materials[1] = material;
      for (std::size_t camera = 0; camera < 2; ++camera) {
        const std::vector<Question>& questions = gallery.of(camera);
        const ImageRgb image = renderImage(dlm.scene, dlm.maps, dlm.scene.cameras[camera],
                                           {kSize, kSize, kRenderers[camera], LightMapFormat::float32});
        const Result r = judge(image, questions, material, set, exponent);
        EXPECT_GT(questions.size(), 300u);
        EXPECT_LT(r.worst, test::zThreshold(3 * questions.size())) << "camera " << camera << ", exponent " << exponent;
        EXPECT_LT(r.noise, directions == 256 && exponent > 10 ? 0.07 : 0.05);  // the question must be sharp enough
        // At least 200 texels are asked for; a pyramid of 1.5 texels makes about five of them depend on each other.
        EXPECT_LT(std::abs(r.mean), 0.005 + 4 * r.noise / std::sqrt(200 / 5.));
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Directions, BakedFurnace,
                         testing::Values(Furnace{14, DirectionFilter::nearest}, Furnace{64, DirectionFilter::nearest},
                                         Furnace{256, DirectionFilter::nearest}, Furnace{14, DirectionFilter::linear},
                                         Furnace{64, DirectionFilter::linear}),
                         [](const auto& furnace) {
                           return std::to_string(furnace.param.directions) + nameOf(furnace.param.filter);
                         });

}  // namespace
}  // namespace lucarne::baked_furnace_test
