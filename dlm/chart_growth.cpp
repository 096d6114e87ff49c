#include "dlm/chart_growth.h"

#include "base/math.h"

namespace lucarne {
namespace {

constexpr double kCosSameShading = 1 - 4e-3;  // about 5°: exporters round vertex normals

bool shadingContinues(const Scene& scene, std::uint32_t t, int k, EdgeLink link) {
  const auto agree = [&scene](std::uint32_t v, std::uint32_t w) {
    return dot(scene.normals[v], scene.normals[w]) > static_cast<float>(kCosSameShading);
  };
  const std::uint32_t *here = scene.triangles[t].v, *there = scene.triangles[link.triangle].v;
  return agree(here[k], there[(link.edge + 1) % 3]) && agree(here[(k + 1) % 3], there[link.edge]);
}

}  // namespace

double cosDegrees(double degrees) {
  const double x = degrees * (kPiD / 180);
  double term = 1, sum = 1;
  for (int k = 2; k < 40; k += 2) {
    term *= -x * x / (k * (k - 1));
    sum += term;
  }
  return sum;
}

void cutCreases(const Scene& scene, HalfEdgeMesh& mesh, double creaseAngleDegrees) {
  const double cosCrease = cosDegrees(creaseAngleDegrees);
  const bool hasNormals = scene.normals.size() == scene.positions.size();
  const auto isSmooth = [&](std::uint32_t t) { return hasNormals && t < scene.smooth.size() && scene.smooth[t] != 0; };
  for (std::uint32_t t = 0; t < mesh.links.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      EdgeLink& link = mesh.links[t][k];
      if (link.triangle == kNone || link.triangle < t) continue;
      const bool keep =
          isSmooth(t) || isSmooth(link.triangle)
              ? shadingContinues(scene, t, k, link)
              : dot(normalize(mesh.scaledNormal(t)), normalize(mesh.scaledNormal(link.triangle))) >= cosCrease;
      if (keep) continue;
      mesh.links[link.triangle][link.edge] = {};
      link = {};
    }
  }
}

ChartGrower::ChartGrower(const ChartFaces& faces, double cosMaxAngle, PlaneTriangleSet& set)
    : faces_(faces), cosMaxAngle_(cosMaxAngle), set_(set), free_(faces.area.size()), triedIn_(faces.area.size(), 0) {
  for (std::uint32_t t = 0; t < free_.size(); ++t) free_[t] = !faces.mesh.degenerate(t);
}

/// Grown twice: once around the seed's normal, then around the mean normal of what that gave, which centres the chart
/// on its part of a curved surface. The plane is the mean normal of the second growth where that keeps the bounds.
GrownChart ChartGrower::take(std::uint32_t seed) {
  Vec3d normal = faces_.normal[seed];
  std::vector<std::uint32_t> chart = grow(seed, normal);
  Vec3d mean = faces_.meanNormal(chart);
  if (faces_.smallestCosine(chart, normal) < kCosFlat && dot(mean, faces_.normal[seed]) >= cosMaxAngle_) {
    std::vector<std::uint32_t> again = grow(seed, mean);
    if (faces_.areaOf(again) >= faces_.areaOf(chart)) {
      chart = std::move(again);
      normal = mean;
      mean = faces_.meanNormal(chart);
    }
  }
  const bool flat = faces_.smallestCosine(chart, normal) >= kCosFlat;
  if (flat || (faces_.smallestCosine(chart, mean) >= cosMaxAngle_ && isOneToOne(chart, mean))) normal = mean;
  for (const std::uint32_t t : chart) free_[t] = false;
  return {normal, std::move(chart)};
}

/// Breadth-first, but what lies in one plane goes before what is beyond a bend.
std::vector<std::uint32_t> ChartGrower::grow(std::uint32_t seed, Vec3d normal) {
  const ProjectionPlane plane(normal, faces_.mesh.corner(seed, 0));
  std::vector<std::uint32_t> chart;
  ++growth_;
  set_.clear();
  flatFront_.assign(1, seed);
  curvedFront_.clear();
  flatHead_ = curvedHead_ = 0;
  while (flatHead_ < flatFront_.size() || curvedHead_ < curvedFront_.size()) {
    const std::uint32_t t = flatHead_ < flatFront_.size() ? flatFront_[flatHead_++] : curvedFront_[curvedHead_++];
    if (triedIn_[t] == growth_) continue;
    triedIn_[t] = growth_;
    if (dot(faces_.normal[t], normal) < cosMaxAngle_ || !set_.tryAdd(faces_.project(t, plane))) continue;
    addWithNeighbours(t, chart);
  }
  return chart;
}

void ChartGrower::addWithNeighbours(std::uint32_t triangle, std::vector<std::uint32_t>& chart) {
  chart.push_back(triangle);
  for (const EdgeLink& link : faces_.mesh.links[triangle]) {
    if (link.triangle == kNone || !free_[link.triangle] || triedIn_[link.triangle] == growth_) continue;
    const bool flat = dot(faces_.normal[triangle], faces_.normal[link.triangle]) >= kCosFlat;
    (flat ? flatFront_ : curvedFront_).push_back(link.triangle);
  }
}

bool ChartGrower::isOneToOne(const std::vector<std::uint32_t>& chart, Vec3d normal) {
  const ProjectionPlane plane(normal, faces_.mesh.corner(chart[0], 0));
  set_.clear();
  return std::all_of(chart.begin(), chart.end(),
                     [&](std::uint32_t t) { return set_.tryAdd(faces_.project(t, plane)); });
}

}  // namespace lucarne
