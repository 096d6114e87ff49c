#if defined(__GNUC__) && !defined(__clang__)
// With sanitizers on, g++ 12 takes OpenMesh's default-constructed points for uninitialised reads, far inside the
// library.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "dlm/half_edge_mesh.h"

#include <numeric>

#include "dlm/chart_edges.h"
#include "dlm/chart_weld.h"
#include "tracer/scene/scene_cleanup.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wcast-align"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#pragma GCC diagnostic pop

namespace lucarne {
namespace {

struct BareTraits : OpenMesh::DefaultTraits {
  VertexAttributes(0);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(0);
  FaceAttributes(0);
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<BareTraits>;

/// OpenMesh tells of a face that it refuses on stderr; the caller handles it, so nobody should hear.
class QuietOpenMesh {
 public:
  QuietOpenMesh() : was_(omerr().is_enabled()) { omerr().disable(); }
  ~QuietOpenMesh() {
    if (was_) omerr().enable();
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

 private:
  bool was_;
};

/// Whether welding left the triangle facing about the same way (a sliver may turn over).
bool keepsItsPlane(const Scene& scene, std::uint32_t t, const Corners& corners) {
  const Vec3d a(scene.positions[corners[0]]), b(scene.positions[corners[1]]), c(scene.positions[corners[2]]);
  const Vec3d before = scene.scaledNormal(t), after = cross(b - a, c - a);
  return dot(before, after) > 0.7 * length(before) * length(after) && length(after) > 0.5 * length(before);
}

/// Builds the mesh in steps; `corners_` holds scene vertices until they become mesh vertices.
class Builder {
 public:
  Builder(const Scene& scene, double weldDistance) : scene_(scene), corners_(scene.triangles.size()) {
    const std::vector<std::uint32_t> welded = weldVertices(scene, weldDistance);
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      corners_[t].fill(kNone);
      if (isSkipped(scene, t)) continue;
      for (int k = 0; k < 3; ++k) corners_[t][k] = welded[scene.triangles[t].v[k]];
      if (!keepsItsPlane(scene, t, corners_[t])) {
        for (int k = 0; k < 3; ++k) corners_[t][k] = scene.triangles[t].v[k];
      }
    }
    partner_ = pairHalfEdges(corners_, scene.triangles);
  }

  HalfEdgeMesh build() {
    splitVertices();
    addFaces();
    link();
    return std::move(result_);
  }

 private:
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

  /// A vertex is a fan of corners that paired edges hold together, so that no fan touches another.
  void splitVertices() {
    parent_.resize(partner_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    const auto next = [](std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
    for (std::uint32_t h = 0; h < partner_.size(); ++h) {
      if (partner_[h] == kNone || partner_[h] < h) continue;
      join(h, next(partner_[h]));
      join(next(h), partner_[h]);
    }
    result_.vertices.assign(corners_.size(), Corners{kNone, kNone, kNone});
    std::vector<std::uint32_t> vertexOf(partner_.size(), kNone);
    for (std::uint32_t h = 0; h < partner_.size(); ++h) {
      if (corners_[h / 3][0] == kNone) continue;
      std::uint32_t& vertex = vertexOf[find(h)];
      if (vertex == kNone) vertex = addVertex(corners_[h / 3][h % 3]);
      result_.vertices[h / 3][h % 3] = vertex;
    }
  }

  std::uint32_t addVertex(std::uint32_t sceneVertex) {
    const Vec3f p = scene_.positions[sceneVertex];
    mesh_.add_vertex({p.x, p.y, p.z});
    result_.positions.emplace_back(p);
    return static_cast<std::uint32_t>(result_.positions.size() - 1);
  }

  static auto handles(const Corners& v) {
    const auto handle = [](std::uint32_t i) { return OpenMesh::VertexHandle(static_cast<int>(i)); };
    return std::array{handle(v[0]), handle(v[1]), handle(v[2])};
  }

  void addFaces() {
    const QuietOpenMesh quiet;
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      if (corners_[t][0] == kNone) continue;
      Corners& v = result_.vertices[t];
      if (!mesh_.add_face(handles(v).data(), 3).is_valid()) {
        // Fans that meet round another way (a Möbius strip's, say): the triangle stands alone, with corners of its own.
        for (int k = 0; k < 3; ++k) v[k] = addVertex(corners_[t][k]);
        mesh_.add_face(handles(v).data(), 3);
      }
      triangleOf_.push_back(t);
    }
  }

  int edgeFrom(std::uint32_t t, OpenMesh::VertexHandle from) const {
    const Corners& v = result_.vertices[t];
    const auto i = static_cast<std::uint32_t>(from.idx());
    return i == v[0] ? 0 : i == v[1] ? 1 : 2;
  }

  void link() {
    result_.links.resize(corners_.size());
    for (const auto halfEdge : mesh_.halfedges()) {
      if (halfEdge.is_boundary() || halfEdge.opp().is_boundary()) continue;
      const std::uint32_t t = triangleOf_[static_cast<std::size_t>(halfEdge.face().idx())];
      const std::uint32_t beyond = triangleOf_[static_cast<std::size_t>(halfEdge.opp().face().idx())];
      const int k = edgeFrom(t, halfEdge.from()), there = edgeFrom(beyond, halfEdge.to());
      if (partner_[3 * t + static_cast<std::uint32_t>(k)] != 3 * beyond + static_cast<std::uint32_t>(there)) continue;
      result_.links[t][k] = {beyond, static_cast<std::uint8_t>(there)};
    }
  }

  const Scene& scene_;
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> partner_, parent_, triangleOf_;
  TriMesh mesh_;
  HalfEdgeMesh result_;
};

}  // namespace

HalfEdgeMesh buildHalfEdgeMesh(const Scene& scene, double weldDistance) { return Builder(scene, weldDistance).build(); }

}  // namespace lucarne
