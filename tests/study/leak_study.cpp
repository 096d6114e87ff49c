// Scores of light that leaks, of rims and of seams, in scenes whose light is known on paper: docs/leaks.md.
//
//   leak_study [PHOTONS]
//
// Each scene is traced once. "without": maps made as if no geometry touched another, seams kept; "with": as a bake
// makes them. Scores are 0 where all is well.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "app/bake_scene.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"
#include "dlm/probe.h"
#include "dlm/resolve.h"
#include "tests/support/scene_builder.h"
#include "tests/support/smooth_sphere.h"
#include "tests/support/textures.h"

namespace lucarne::studies {
namespace {

using test::SceneBuilder;

constexpr double kTexel = 1.0 / 16;  // m
constexpr double kCandela = 100;     // of bulbs

/// One way to make maps of one traced scene.
class Way {
 public:
  Way(const Scene& scene_, const BakePlan& plan_, Baked baked_)
      : scene(scene_), plan(plan_), baked(std::move(baked_)) {}
  const Scene& scene;
  const BakePlan& plan;
  Baked baked;

  /// Irradiance (luminance, lx) at a point, as the program answers.
  double at(Vec3d position, Vec3d normal) {
    if (!prober_) {
      const std::filesystem::path folder = std::filesystem::temp_directory_path() / "lucarne_leak_study.dlm";
      writeDlm(folder, scene, baked.uv, baked.maps, nlohmann::json::object(), {});
      dlm_ = std::make_unique<Dlm>(readDlm(folder));
      std::filesystem::remove_all(folder);
      prober_ = std::make_unique<Prober>(*dlm_);
    }
    return luminance(prober_->probe(position, normal).irradiance);
  }

 private:
  std::unique_ptr<Dlm> dlm_;
  std::unique_ptr<Prober> prober_;
};

/// A scene with its light, and what is asked of it.
struct Case {
  std::string name;
  Scene scene;
  std::function<double(Way&)> score;
};

void run(const Case& c, std::uint64_t photons) {
  BakeOptions options;
  options.photons = photons;
  options.texelsPerMetre = 1 / kTexel;
  const PhotonScene scene(c.scene);
  const BakePlan plan = makePlan(c.scene, options);
  Tallies tallies(plan.tallies);
  PartHeader header;
  header.identity.emittedFlux = scene.emitters().totalFlux();
  const TexelMap map(c.scene, plan.charts, plan.layout, plan.tallies);
  runPhotons({scene, map, plan.tallies, plan.directions}, {0, photons}, runOptions(options), tallies, header.ledger,
             [](const RunProgress&) { return true; });
  Way without{c.scene, plan, {}}, with{c.scene, plan, resolveBake(c.scene, plan, options, header, tallies)};
  without.baked.maps = resolve({c.scene, plan.charts, plan.layout, plan.tallies, tallies, options.directions,
                                header.identity.emittedFlux, photons},
                               options.kernel);
  without.baked.seams = fitSeams(findSeams(c.scene, plan.charts, plan.layout, without.baked.maps, {}), plan.layout,
                                 without.baked.maps, false);
  without.baked.uv = placeInAtlas(plan.charts, plan.layout, without.baked.maps);
  const double before = c.score(without), after = c.score(with);
  std::printf("| %s | %.4f | %.4f |\n", c.name.c_str(), before, after);
}

Light bulbAt(Vec3d p) {
  Light light;
  light.kind = LightKind::point;
  light.intensity = Rgb(static_cast<float>(kCandela));
  light.position = p;
  return light;
}

double underBulb(Vec3d bulb, Vec3d p) {
  const Vec3d d = bulb - p;
  return kCandela * d.y / (dot(d, d) * length(d));
}

/// Root mean square over the points of reading / truth − 1, on a floor under a bulb.
double rimOf(Way& way, Vec3d bulb, const std::vector<Vec3d>& points) {
  double sum = 0;
  for (const Vec3d p : points) {
    const double off = way.at(p, {0, 1, 0}) / underBulb(bulb, p) - 1;
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Points around a rectangle on the floor, from the shadow's edge to two texels off.
std::vector<Vec3d> around(Vec3d lo, Vec3d hi, double shadow) {
  std::vector<Vec3d> points;
  for (const double away : {0.05, 0.3, 0.7, 1.2, 2.0}) {
    const double d = shadow + away * kTexel;
    for (int i = 0; i <= 12; ++i) {
      const double x = lo.x + (hi.x - lo.x) * i / 12, z = lo.z + (hi.z - lo.z) * i / 12;
      points.insert(points.end(), {{x, 0, lo.z - d}, {x, 0, hi.z + d}, {lo.x - d, 0, z}, {hi.x + d, 0, z}});
    }
  }
  return points;
}

SceneBuilder floorUnder(Vec3d bulb) {
  SceneBuilder s;
  s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, s.addDiffuse(Rgb(0.f)));
  s.addLight(bulbAt(bulb));
  return s;
}

Case boxOnFloor(const std::string& name, Vec3d lo, Vec3d hi, bool doubleSided) {
  const Vec3d bulb{0.5 * (lo.x + hi.x), 1.5, 0.5 * (lo.z + hi.z)};
  SceneBuilder s = floorUnder(bulb);
  Material m = test::diffuseMaterial(Rgb(0.f));
  m.doubleSided = doubleSided;
  s.addBox(lo, hi, s.addMaterial(m));
  const double shadow = 0.5 * (hi.x - lo.x) * hi.y / (bulb.y - hi.y) + 1e-4;
  return {name, s.build(), [=](Way& way) {
            return rimOf(way, bulb, around(lo, hi, std::max(shadow, 0.5 * (hi.z - lo.z) * hi.y / (bulb.y - hi.y))));
          }};
}

/// Two rooms, 4 × 2 × 2 m together, a wall of 1 mm from floor to ceiling between them, a bulb in the right one.
SceneBuilder twoRooms(double wall, Vec3d bulb) {
  SceneBuilder s;
  const auto black = s.addDiffuse(Rgb(0.f));
  s.addBox({-2, 0, -1}, {2, 2, 1}, black, true);
  s.addQuad({wall - 5e-4, 0, -1}, {wall - 5e-4, 0, 1}, {wall - 5e-4, 2, 1}, {wall - 5e-4, 2, -1}, black);
  s.addQuad({wall + 5e-4, 0, 1}, {wall + 5e-4, 0, -1}, {wall + 5e-4, 2, -1}, {wall + 5e-4, 2, 1}, black);
  s.addLight(bulbAt(bulb));
  return s;
}

/// Over the dark side: the largest reading of the wall's face, or the mean of the floor up to `texels` from the wall,
/// over the irradiance of the lit floor beside the wall.
double darkFloor(Way& way, double wall, Vec3d bulb, double from, double to) {
  double sum = 0;
  int n = 0;
  for (double d = from; d < to; d += 0.1)
    for (double z = -0.8; z < 0.8; z += 0.07, ++n) sum += way.at({wall - 6e-4 - d * kTexel, 0, z}, {0, 1, 0});
  return sum / n / underBulb(bulb, {wall, 0, 0});
}

double litFloor(Way& way, double wall, Vec3d bulb) {
  std::vector<Vec3d> points;
  for (double d = 0.05; d < 2; d += 0.1)
    for (double z = -0.8; z < 0.8; z += 0.07) points.push_back({wall + 6e-4 + d * kTexel, 0, z});
  return rimOf(way, bulb, points);
}

std::vector<Case> walls() {
  std::vector<Case> all;
  const Vec3d bulb{1, 1, 0};
  for (const double wall : {0.0, 0.011, 0.031}) {
    const Scene scene = twoRooms(wall, bulb).build();
    const std::string at = " (" + std::to_string(static_cast<int>(wall / kTexel * 100)) + " % into a texel)";
    all.push_back({"1 mm wall, its dark face" + at, scene, [=](Way& way) {
                     double most = 0;
                     for (double y = 0.01; y < 2; y += 0.05)
                       for (double z = -0.95; z < 1; z += 0.07)
                         most = std::max(most, way.at({wall - 5e-4, y, z}, {-1, 0, 0}));
                     return most / underBulb(bulb, {wall, 0, 0});
                   }});
    all.push_back(
        {"— dark floor, nearest texel" + at, scene, [=](Way& way) { return darkFloor(way, wall, bulb, 0.05, 1); }});
    all.push_back(
        {"— dark floor, next two texels" + at, scene, [=](Way& way) { return darkFloor(way, wall, bulb, 1.55, 3); }});
    all.push_back({"— lit floor, two texels" + at, scene, [=](Way& way) { return litFloor(way, wall, bulb); }});
  }
  return all;
}

Case sealedBox() {
  SceneBuilder s;
  s.addBox({-2, 0, -2}, {2, 2, 2}, s.addDiffuse(Rgb(0.5f)), true);
  s.addQuad({-1, 1.9, -1}, {1, 1.9, -1}, {1, 1.9, 1}, {-1, 1.9, 1}, s.addDiffuse(Rgb(0.5f), Rgb(500.f)));
  Material m = test::diffuseMaterial(Rgb(0.5f));
  m.doubleSided = true;
  s.addBox({-0.4, 0, -0.3}, {0.5, 0.9, 0.6}, s.addMaterial(m));
  return {"sealed box in a bright room: largest texel inside, lx", s.build(), [](Way& way) {
            double most = 0;
            for (const SideMaps& side : way.baked.maps.sides)
              for (std::uint64_t t = 0; side.back && side.lit && t < side.texelCount(); ++t)
                most = std::max(most, static_cast<double>(luminance(way.baked.maps.irradiance[side.firstTexel + t])));
            return most;
          }};
}

Case rug(const std::string& name, double height) {
  const Vec3d bulb{-0.06, 1.5, -0.07}, lo{-0.33, 0, -0.41}, hi{0.21, 0, 0.27};
  SceneBuilder s = floorUnder(bulb);
  s.addQuad({lo.x, height, hi.z}, {hi.x, height, hi.z}, {hi.x, height, lo.z}, {lo.x, height, lo.z},
            s.addDiffuse(Rgb(0.f)));
  return {name, s.build(), [=](Way& way) { return rimOf(way, bulb, around(lo, hi, 0.36 * height)); }};
}

Case ball() {
  SceneBuilder s;
  const auto m = s.addDiffuse(Rgb(0.f));
  test::addSphere(s, {0, 0, 0}, 0.5, m, 10);
  s.addLight(bulbAt({0, 4, 0}));
  Scene scene = s.build();
  test::smoothen(scene, m, {0, 0, 0});
  return {"smooth ball of 600 facets under a bulb: RMS from the round one", scene, [](Way& way) {
            double sum = 0;
            int n = 0;
            for (double a = 0.02; a < 6.28; a += 0.11) {
              for (double c = 0.4; c < 1; c += 0.021, ++n) {
                const double r = std::sqrt(1 - c * c);
                const Vec3d d{r * std::cos(a), c, r * std::sin(a)}, p = d * 0.5, to = Vec3d{0, 4, 0} - p;
                const double e = kCandela * dot(d, to) / (dot(to, to) * length(to));
                const double off = way.at(p, d) / e - 1;
                sum += off * off;
              }
            }
            return std::sqrt(sum / n);
          }};
}

double rmsJump(Way& way) { return way.baked.seams.jumpAfter; }

/// Root mean square of the jump between readings on both sides of the line x = 0.037, over their mean.
double jumpAcrossJoint(Way& way) {
  double difference = 0, mean = 0;
  for (double z = -0.99; z < 1; z += 0.01) {
    const double a = way.at({0.037 - 1e-6, 0, z}, {0, 1, 0}), b = way.at({0.037 + 1e-6, 0, z}, {0, 1, 0});
    difference += (a - b) * (a - b);
    mean += 0.25 * (a + b) * (a + b);
  }
  return std::sqrt(difference / mean);
}

Case joint() {
  const Vec3d bulb{0.2, 1, 0.1};
  SceneBuilder s;
  const auto a = s.addDiffuse(Rgb(0.f)), b = s.addDiffuse(Rgb(0.1f));
  s.addQuad({-1, 0, 1}, {0.037, 0, 1}, {0.037, 0, -1}, {-1, 0, -1}, a);
  s.addQuad({0.037, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0.037, 0, -1}, b);
  s.addLight(bulbAt(bulb));
  return {"floor of two charts: RMS jump at the seam", s.build(), rmsJump};
}

/// The floor of joint(), its right part of three quads: the edge of the left runs along three of the right. Asked by
/// places, since the figures of the seams are those of seams that were found.
Case jointOfThree() {
  SceneBuilder s;
  const auto a = s.addDiffuse(Rgb(0.f)), b = s.addDiffuse(Rgb(0.1f));
  s.addQuad({-1, 0, 1}, {0.037, 0, 1}, {0.037, 0, -1}, {-1, 0, -1}, a);
  for (const auto& [from, to] : {std::pair{1.0, 0.43}, std::pair{0.43, -0.31}, std::pair{-0.31, -1.0}})
    s.addQuad({0.037, 0, from}, {1, 0, from}, {1, 0, to}, {0.037, 0, to}, b);
  s.addLight(bulbAt({0.2, 1, 0.1}));
  return {"— one edge along three", s.build(), jumpAcrossJoint};
}

/// Furnace: 200π lx everywhere.
SceneBuilder furnace() {
  SceneBuilder s;
  s.addBox({-1, -1, -1}, {1, 1, 1}, s.addDiffuse(Rgb(0.5f), Rgb(100.f)), true);
  return s;
}

double furthestMean(Way& way, std::uint32_t material) {
  double flux = 0, area = 0;
  for (const SideMaps& side : way.baked.maps.sides) {
    if (way.baked.maps.charts[side.chart].material != material || !side.lit) continue;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      const double a = way.plan.layout.area[way.plan.layout.charts[side.chart].firstTexel + t];
      flux += a * static_cast<double>(luminance(way.baked.maps.irradiance[side.firstTexel + t]));
      area += a;
    }
  }
  return std::abs(flux / area / (200 * std::numbers::pi) - 1);
}

Case alpha() {
  SceneBuilder s = furnace();
  Material m = test::diffuseMaterial(Rgb(0.5f), Rgb(100.f));
  m.doubleSided = true;
  m.alphaMode = AlphaMode::blend;
  const auto index = s.addMaterial(m);
  s.addQuad({-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 0, -0.5}, index);
  Scene scene = s.build();
  scene.materials[index].baseColorTexture = test::addTexture(scene, 16, [](int x, int y) {
    return std::array<std::uint8_t, 4>{255, 255, 255, static_cast<std::uint8_t>((x * 16 + y * 3) % 256)};
  });
  return {"veil of varied alpha in a furnace: its mean light, off by", scene,
          [=](Way& way) { return furthestMean(way, index); }};
}

Case unwritten() {
  SceneBuilder s = furnace();
  const auto m = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  s.addTriangle({-0.6, -0.3, 0.1}, {0.7, -0.2, 0.3}, {0.1, 0.8, -0.1}, m);
  s.addTriangle({-0.6, -0.6, 0.1}, {0.9, -0.601, 0.3}, {0.9, -0.6, 0.3}, m);
  return {"charts of slanted triangles: share of texels that read under half", s.build(), [](Way& way) {
            std::uint64_t few = 0, all = 0;
            for (const SideMaps& side : way.baked.maps.sides)
              for (std::uint64_t t = 0; side.lit && t < side.texelCount(); ++t, ++all)
                few += luminance(way.baked.maps.irradiance[side.firstTexel + t]) < 100 * std::numbers::pi ? 1 : 0;
            return static_cast<double>(few) / static_cast<double>(all);
          }};
}

}  // namespace
}  // namespace lucarne::studies

int main(int argc, char** argv) {
  using namespace lucarne::studies;
  const std::uint64_t photons = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 4'000'000;
  std::vector<Case> cases = {sealedBox()};
  for (Case& c : walls()) cases.push_back(std::move(c));
  cases.push_back(boxOnFloor("wall of 12 cm on a floor: RMS rim", {-0.531, 0, -0.06}, {0.44, 0.02, 0.06}, false));
  cases.push_back(boxOnFloor("leg of 8.6 cm on a floor: RMS rim", {-0.012, 0, -0.026}, {0.074, 0.05, 0.06}, false));
  cases.push_back(boxOnFloor("— of a two-sided material", {-0.012, 0, -0.026}, {0.074, 0.05, 0.06}, true));
  cases.push_back(boxOnFloor("— 2 cm into the floor", {-0.012, -0.02, -0.026}, {0.074, 0.05, 0.06}, false));
  cases.push_back(boxOnFloor("chest of 40 cm, two-sided material: RMS rim", {-0.2, 0, -0.17}, {0.2, 0.02, 0.23}, true));
  cases.push_back(rug("rug 2 mm over a floor: RMS rim", 0.002));
  cases.push_back(rug("— 8 mm over it", 0.008));
  cases.push_back(boxOnFloor("— 12 mm thick, laid into it", {-0.33, -0.003, -0.41}, {0.21, 0.009, 0.27}, false));
  cases.push_back(ball());
  cases.push_back(joint());
  cases.push_back(jointOfThree());
  cases.push_back(alpha());
  cases.push_back(unwritten());
  std::printf("| | without | with |\n|---|---|---|\n");
  for (const Case& c : cases) run(c, photons);
  return 0;
}
