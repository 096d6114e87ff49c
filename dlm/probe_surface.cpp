#include "dlm/probe_surface.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>

#include "dlm/probe_closest.h"

namespace lucarne {

namespace {

constexpr double kAgreement = 0.5;      // smallest dot product of the normals
constexpr double kUnseenPenalty = 0.1;  // texels
constexpr double kRounding = 1e-6;      // local units: of the float coordinates in Embree's tree
constexpr double kWholeScene = 4;       // local units: more than the extent of any scene

}  // namespace

// Embree visits the triangles whose boxes are within the radius; distances are ours, in double.
class SurfaceFinder::Query {
 public:
  Query(const SurfaceFinder& finder, Vec3d local, Vec3d n) : finder_(finder), local_(local), n_(n) {}

  std::optional<Candidate> run() {
    RTCPointQuery query;
    query.x = static_cast<float>(local_.x);
    query.y = static_cast<float>(local_.y);
    query.z = static_cast<float>(local_.z);
    query.time = 0;
    query.radius = radiusFor(finder_.largestTexel_);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(finder_.caster_.embreeScene(), &query, &context, &Query::visit, this);
    return best_;
  }

 private:
  static float radiusFor(double distance) {
    return static_cast<float>(std::min(distance, kWholeScene) * (1 + kRounding) + kRounding);
  }

  // True when the radius was lowered.
  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    Query& self = *static_cast<Query*>(arguments->userPtr);
    const std::optional<Candidate> found = self.finder_.judge(arguments->primID, self.local_, self.n_);
    if (!found) return false;
    std::optional<Candidate>& best = self.best_;
    // Smallest index on a tie, so that the answer does not depend on the order of the tree.
    if (best && (found->score > best->score || (found->score == best->score && found->triangle > best->triangle)))
      return false;
    best = found;
    const float radius = radiusFor(found->score);
    if (!(radius < arguments->query->radius)) return false;
    arguments->query->radius = radius;
    return true;
  }

  const SurfaceFinder& finder_;
  Vec3d local_, n_;
  std::optional<Candidate> best_;
};

SurfaceFinder::SurfaceFinder(const Scene& scene, const LightMaps& maps)
    : scene_(scene), maps_(maps), caster_(scene), largestTexel_(0) {
  for (const MapChart& chart : maps.charts)
    largestTexel_ = std::max(largestTexel_, chart.texelSize / scene.frame.scale);
}

std::optional<SurfacePoint> SurfaceFinder::find(Vec3d position, Vec3d n) const {
  const Vec3d local = scene_.frame.toLocal(position);
  const bool near = std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) <= 2 * kWholeScene;
  if (!near || scene_.triangles.empty()) return std::nullopt;
  const std::optional<Candidate> found = Query(*this, local, n).run();
  if (!found) return std::nullopt;
  return describe(*found);
}

std::optional<SurfaceFinder::Candidate> SurfaceFinder::judge(std::uint32_t triangle, Vec3d local, Vec3d n) const {
  const std::uint32_t index = scene_.chartOfTriangle[triangle];
  if (index == kNone) return std::nullopt;
  const MapChart& chart = maps_.charts[index];
  const ClosestPoint closest = closestPoint(local, Vec3d(scene_.corner(triangle, 0)), Vec3d(scene_.corner(triangle, 1)),
                                            Vec3d(scene_.corner(triangle, 2)));
  const double texel = chart.texelSize / scene_.frame.scale;
  if (!(closest.distance <= texel + kRounding)) return std::nullopt;
  const double facing = dot(normalize(scene_.scaledNormal(triangle)), n);
  const double shading = chart.smooth ? dot(shadingNormal(triangle, closest.b1, closest.b2), n) : facing;
  const bool front = std::max(facing, shading) > kAgreement;
  if (!front && !(std::min(facing, shading) < -kAgreement)) return std::nullopt;
  const bool unseen = (front ? chart.frontSide : chart.backSide) == kNone;
  return Candidate{closest.distance + (unseen ? kUnseenPenalty * texel : 0), triangle, !front, closest.b1, closest.b2};
}

Vec3d SurfaceFinder::shadingNormal(std::uint32_t triangle, double b1, double b2) const {
  const auto& v = scene_.triangles[triangle].v;
  return normalize(Vec3d(scene_.normals[v[0]]) * (1 - b1 - b2) + Vec3d(scene_.normals[v[1]]) * b1 +
                   Vec3d(scene_.normals[v[2]]) * b2);
}

SurfacePoint SurfaceFinder::describe(const Candidate& candidate) const {
  SurfacePoint point;
  point.triangle = candidate.triangle;
  point.chart = scene_.chartOfTriangle[candidate.triangle];
  point.back = candidate.back;
  const MapChart& chart = maps_.charts[point.chart];
  Vec3d normal = chart.smooth   ? shadingNormal(candidate.triangle, candidate.b1, candidate.b2)
                 : chart.planar ? normalize(Vec3d(chart.normal))
                                : normalize(scene_.scaledNormal(candidate.triangle));
  point.normal = candidate.back ? -normal : normal;

  const double b[3] = {1 - candidate.b1 - candidate.b2, candidate.b1, candidate.b2};
  Vec2d uv{};
  for (int k = 0; k < 3; ++k) {
    const Vec2f corner = scene_.atlasUv[scene_.triangles[candidate.triangle].v[k]];
    uv = uv + Vec2d{static_cast<double>(corner.x), static_cast<double>(corner.y)} * b[k];
  }
  point.st = {uv.x * maps_.atlasWidth - chart.atlasX, uv.y * maps_.atlasHeight - chart.atlasY};
  return point;
}

}  // namespace lucarne
