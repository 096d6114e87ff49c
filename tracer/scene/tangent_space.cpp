#include "tracer/scene/tangent_space.h"

#include <array>
#include <bit>
#include <unordered_map>

#include "base/math.h"

namespace lucarne {
namespace {

struct PointKey {
  Vec3f position, normal;
  Vec2f uv;
  bool operator==(const PointKey&) const = default;
};

struct PointKeyHash {
  std::size_t operator()(const PointKey& k) const {
    std::uint64_t h = 0;
    for (const float part :
         {k.position.x, k.position.y, k.position.z, k.normal.x, k.normal.y, k.normal.z, k.uv.x, k.uv.y}) {
      h = (h ^ std::bit_cast<std::uint32_t>(part + 0.f)) * 0x9e3779b97f4a7c15u;  // + 0: −0 equals 0
      h ^= h >> 32;
    }
    return h;
  }
};

/// Which way the texture lies on a triangle; the index of its sums.
enum Side : std::uint8_t { kUpright, kMirrored, kNeither };

struct TriangleTangent {
  Vec3d along;  // +u, of any length
  Side side = kNeither;
};

class TangentComputer {
 public:
  TangentComputer(Scene& scene, const TextureUse& use)
      : scene_(scene), instance_(scene.instances.back()), use_(use), uv_(use.uvSet == 0 ? scene.uv0 : scene.uv1) {}

  void compute() {
    weldVertices();
    const std::uint32_t end = instance_.firstTriangle + instance_.triangleCount;
    for (std::uint32_t t = instance_.firstTriangle; t < end; ++t) addTriangle(t);
    for (std::uint32_t t = instance_.firstTriangle; t < end; ++t) {
      const Side side = tangentOf(t).side;
      for (std::uint32_t& v : scene_.triangles[t].v) v = vertexOf(v, side);
    }
    instance_.vertexCount = static_cast<std::uint32_t>(scene_.positions.size()) - instance_.firstVertex;
  }

 private:
  struct Point {
    std::array<Vec3d, 2> sum{};  // by side
    std::array<bool, 2> has{};   // a triangle of that side
  };
  struct Vertex {
    std::uint32_t point = 0;
    std::array<std::uint32_t, 2> bySide{kNone, kNone};  // the scene's vertex
  };

  Vec2f uv(std::uint32_t v) const { return v < uv_.size() ? uv_[v] : Vec2f{}; }
  void weldVertices();
  TriangleTangent tangentOf(std::uint32_t t) const;
  void addTriangle(std::uint32_t t);
  std::uint32_t vertexOf(std::uint32_t v, Side side);
  std::uint32_t copyOf(std::uint32_t v);
  Vec4f meanTangent(const Point& point, Side side, Vec3f normal) const;

  Scene& scene_;
  PrimitiveInstance& instance_;
  const TextureUse use_;
  std::vector<Vec2f>& uv_;
  std::vector<Vertex> vertices_;  // of the instance as it was
  std::vector<Point> points_;
};

void TangentComputer::weldVertices() {
  std::unordered_map<PointKey, std::uint32_t, PointKeyHash> known;
  vertices_.resize(instance_.vertexCount);
  for (std::uint32_t i = 0; i < instance_.vertexCount; ++i) {
    const std::uint32_t v = instance_.firstVertex + i;
    const PointKey key{scene_.positions[v], scene_.normals[v], uv(v)};
    vertices_[i].point = known.try_emplace(key, static_cast<std::uint32_t>(known.size())).first->second;
  }
  points_.resize(known.size());
}

/// With edges e = ∂P/∂u du + ∂P/∂v dv: ∂P/∂u = (e1 dv2 − e2 dv1) / det, det = du1 dv2 − du2 dv1. Seen from the front,
/// det has the sign of cross(∂P/∂u, ∂P/∂v) · n: negative where the image stands upright, its v pointing down.
TriangleTangent TangentComputer::tangentOf(std::uint32_t t) const {
  const auto& v = scene_.triangles[t].v;
  const auto delta = [&](int k) {
    const Vec2f a = uv(v[0]), b = uv(v[k]);
    const Vec2d d{double{b.x} - a.x, double{b.y} - a.y};
    return Vec2d{use_.rowU.x * d.x + use_.rowU.y * d.y, use_.rowV.x * d.x + use_.rowV.y * d.y};
  };
  const Vec2d d1 = delta(1), d2 = delta(2);
  const double det = d1.x * d2.y - d2.x * d1.y;
  if (det == 0 || scene_.scaledNormal(t) == Vec3d{}) return {};
  const Vec3d p(scene_.corner(t, 0)), e1 = Vec3d(scene_.corner(t, 1)) - p, e2 = Vec3d(scene_.corner(t, 2)) - p;
  const Vec3d along = e1 * d2.y - e2 * d1.y;
  return det < 0 ? TriangleTangent{-along, kUpright} : TriangleTangent{along, kMirrored};
}

void TangentComputer::addTriangle(std::uint32_t t) {
  const TriangleTangent tangent = tangentOf(t);
  if (tangent.side == kNeither) return;
  const auto& v = scene_.triangles[t].v;
  for (int k = 0; k < 3; ++k) {
    const Vec3f n = scene_.normals[v[k]];
    const Vec3d p(scene_.corner(t, k));
    const Vec3d a = inPlane(Vec3d(scene_.corner(t, (k + 1) % 3)) - p, n);
    const Vec3d b = inPlane(Vec3d(scene_.corner(t, (k + 2) % 3)) - p, n);
    Point& point = points_[vertices_[v[k] - instance_.firstVertex].point];
    point.sum[tangent.side] += inPlane(tangent.along, n) * acos(dot(a, b));
    point.has[tangent.side] = true;
  }
}

/// The vertex that triangles of one side use instead of `v`: itself for the side that comes first, a copy for the
/// other.
std::uint32_t TangentComputer::vertexOf(std::uint32_t v, Side side) {
  Vertex& vertex = vertices_[v - instance_.firstVertex];
  const Point& point = points_[vertex.point];
  if (side == kNeither) side = point.has[kMirrored] && !point.has[kUpright] ? kMirrored : kUpright;
  std::uint32_t& mine = vertex.bySide[side];
  if (mine != kNone) return mine;
  mine = vertex.bySide[side == kUpright ? kMirrored : kUpright] == kNone ? v : copyOf(v);
  scene_.tangents[mine] = meanTangent(point, side, scene_.normals[v]);
  return mine;
}

std::uint32_t TangentComputer::copyOf(std::uint32_t v) {
  const std::size_t copy = scene_.positions.size();
  scene_.positions.push_back(Vec3f(scene_.positions[v]));
  scene_.normals.push_back(Vec3f(scene_.normals[v]));
  scene_.sourceVertex.push_back(std::uint32_t{scene_.sourceVertex[v]});
  scene_.tangents.push_back({});
  for (std::vector<Vec2f>* uv : {&scene_.uv0, &scene_.uv1, &scene_.atlasUv}) {
    if (v >= uv->size()) continue;  // the reader fills the others at its end
    uv->resize(copy + 1);
    uv->back() = (*uv)[v];
  }
  return static_cast<std::uint32_t>(copy);
}

Vec4f TangentComputer::meanTangent(const Point& point, Side side, Vec3f normal) const {
  const Vec3f t(inPlane(point.sum[side], normal));
  Vec4f any = anyTangent(normal);
  any.w = side == kMirrored ? -1.f : 1.f;
  return t == Vec3f{} ? any : Vec4f{t.x, t.y, t.z, any.w};
}

}  // namespace

Vec4f anyTangent(Vec3f normal) {
  const Vec3f s(Frame<double>(Vec3d(normal)).s);
  return {s.x, s.y, s.z, 1};
}

Vec3d inPlane(Vec3d direction, Vec3f normal) {
  // First to about one, so that neither tiny nor huge vectors are lost in the squares.
  const double size = std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
  if (!(size > 0 && size <= 1e300)) return {};
  const Vec3d d = direction / size, n(normal);
  const Vec3d flat = d - n * (dot(d, n) / dot(n, n));
  constexpr double kLeast = 1e-6;  // what rounding of the normal leaves of a vector along it
  return length(flat) > kLeast ? normalize(flat) : Vec3d{};
}

void fillTangents(Scene& scene) {
  for (std::size_t v = scene.tangents.size(); v < scene.positions.size(); ++v) {
    scene.tangents.push_back(anyTangent(scene.normals[v]));
  }
}

void computeTangents(Scene& scene, const TextureUse& normalMap) {
  fillTangents(scene);
  TangentComputer(scene, normalMap).compute();
}

}  // namespace lucarne
