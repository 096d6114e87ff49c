#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "app/map_difference.h"
#include "dlm/probe.h"

namespace lucarne {
namespace {

/// The sides that take light, triangle by triangle, with the area up to each.
class Surfaces {
 public:
  explicit Surfaces(const Dlm& dlm) : scene_(dlm.scene) {
    const double square = scene_.frame.scale * scene_.frame.scale;
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
      if (scene_.chartOfTriangle[t] == kNone) continue;
      const MapChart& chart = dlm.maps.charts[scene_.chartOfTriangle[t]];
      for (const bool back : {false, true}) {
        if ((back ? chart.backSide : chart.frontSide) == kNone) continue;
        area_ += 0.5 * length(scene_.scaledNormal(t)) * square;
        pieces_.push_back({t, back, area_});
      }
    }
  }
  double area() const { return area_; }

  struct Point {
    Vec3d position, normal;  // metres; toward the side
  };
  /// u in [0, 1) chooses by area, (v, w) in [0, 1)² the place on the triangle.
  Point at(double u, double v, double w) const {
    auto piece = std::upper_bound(pieces_.begin(), pieces_.end(), u * area_,
                                  [](double x, const Piece& p) { return x < p.upTo; });
    if (piece == pieces_.end()) --piece;
    const double root = std::sqrt(v);
    const Vec3d local = Vec3d(scene_.corner(piece->triangle, 0)) * (1 - root) +
                        Vec3d(scene_.corner(piece->triangle, 1)) * (root * (1 - w)) +
                        Vec3d(scene_.corner(piece->triangle, 2)) * (root * w);
    const Vec3d n = normalize(scene_.scaledNormal(piece->triangle));
    return {scene_.frame.toWorld(local), piece->back ? -n : n};
  }

 private:
  struct Piece {
    std::uint32_t triangle;
    bool back;
    double upTo;
  };
  const Scene& scene_;
  std::vector<Piece> pieces_;
  double area_ = 0;
};

struct Answers {
  ProbeAnswer a, b;
  Vec3d position{};
};

double fraction(double x) { return x - std::floor(x); }

/// Both lists are by ascending ψ. A member that one side lacks has no light there.
void addDirections(const Answers& answers, double area, MapDifference& difference) {
  const auto &a = answers.a.directions, &b = answers.b.directions;
  if (a.empty() || b.empty()) return;
  for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
    const int psi = i == a.size() ? b[k].psi : k == b.size() ? a[i].psi : std::min(a[i].psi, b[k].psi);
    Rgbd inA{}, inB{};
    if (i < a.size() && a[i].psi == psi) inA = a[i++].irradiance;
    if (k < b.size() && b[k].psi == psi) inB = b[k++].irradiance;
    difference.addDirection(psi, area, inA, inB);
  }
}

void addPoint(const Answers& answers, double area, MapDifference& difference) {
  if (!answers.a.onSurface || !answers.b.onSurface) {
    ++difference.withoutCounterpart;
    return;
  }
  MapSample s{area,
              answers.a.chart,
              answers.a.back,
              answers.a.irradiance,
              answers.b.irradiance,
              answers.a.relativeError,
              answers.b.relativeError};
  if (difference.add(s)) difference.worst.position = answers.position;
  if (difference.sameDirections()) addDirections(answers, area, difference);
}

}  // namespace

void comparePoints(const Dlm& a, const Dlm& b, std::uint64_t points, MapDifference& difference) {
  const Surfaces surfaces(a);
  if (!(surfaces.area() > 0)) return;
  const Prober proberA(a), proberB(b);
  const double area = surfaces.area() / static_cast<double>(points);
  constexpr std::uint64_t kBlock = 4096;  // answers kept at once: those of thousands of directions are large
  std::vector<Answers> answers(std::min(kBlock, points));
  for (std::uint64_t start = 0; start < points; start += kBlock) {
    const std::uint64_t count = std::min(kBlock, points - start);
    tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t k) {
      const auto i = static_cast<double>(start + k);
      // Evenly by area; on the triangle a lattice of the golden ratio's generalisation to the plane (Roberts 2018).
      const Surfaces::Point p =
          surfaces.at((i + 0.5) / static_cast<double>(points), fraction(0.5 + i * 0.7548776662466927),
                      fraction(0.5 + i * 0.5698402909980532));
      answers[k] = {proberA.probe(p.position, p.normal, ProbeDetail::irradiance),
                    proberB.probe(p.position, p.normal, ProbeDetail::irradiance), p.position};
    });
    for (std::uint64_t k = 0; k < count; ++k) addPoint(answers[k], area, difference);
  }
}

}  // namespace lucarne
