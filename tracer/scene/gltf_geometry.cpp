#include "tracer/scene/gltf_geometry.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/scene/gltf_accessor.h"
#include "tracer/scene/gltf_tangents.h"
#include "tracer/scene/local_frame.h"
#include "tracer/scene/tangent_space.h"

namespace lucarne {
namespace {

constexpr double kMaxCoordinate = 1e100;      // metres; squares of it stay in range
constexpr double kSmoothCosine = 0.99994517;  // cos 0.6°: shading normals nearer than that count as flat
constexpr double kLeastCosine = 0.05;         // shading normals further from the geometric one are not used
constexpr double kMaxChart = 16777216;        // whole numbers that float can hold

std::optional<Accessor> attributeOf(const GltfSource& source, const Json& primitive, const std::string& name) {
  const Json* index = findMember(primitive["attributes"], name.c_str());
  if (index == nullptr) return std::nullopt;
  return Accessor(source, index->get<std::uint32_t>());
}

Vec3d vector3(const Accessor& accessor, std::uint32_t i) {
  return {accessor.value(i, 0), accessor.value(i, 1), accessor.value(i, 2)};
}

Vec3d worldPosition(const Accessor& positions, const Affine& world, std::uint32_t vertex, const GltfSource& source,
                    const PrimitiveUse& use) {
  const Vec3d p = world.point(vector3(positions, vertex));
  const bool good =
      std::fabs(p.x) < kMaxCoordinate && std::fabs(p.y) < kMaxCoordinate && std::fabs(p.z) < kMaxCoordinate;
  if (!good) {
    primitivePlace(source, use.mesh, use.primitive)
        .fail("vertex " + std::to_string(vertex) + " has a position that is not a finite number of metres");
  }
  return p;
}

/// Normals go with the cofactors of the linear part, up to its determinant's sign: cof(M) = det(M) · M^-T. Where the
/// map mirrors, the winding is turned round, and so is the front's normal: the sign drops out of both.
Affine normalMap(const WorldNode& node) {
  const Affine m = balanced(node.world);
  const double sign = node.mirrors ? -1 : 1;
  return {cross(m.c1, m.c2) * sign, cross(m.c2, m.c0) * sign, cross(m.c0, m.c1) * sign, {}};
}

/// Appends one primitive instance to the scene.
class InstanceReader {
 public:
  InstanceReader(const GltfSource& source, const WorldNode& node, const PrimitiveUse& use, const UvSlots& slots,
                 Scene& scene, std::vector<std::uint32_t>& sharedVertex);
  void read(std::uint32_t material);
  /// After read(). Tangents of a primitive without normals do not count (glTF 2.0, 3.7.2.1).
  void addTangents(const TextureUse& normalMap);
  /// Whether _CHART held something that is no chart number.
  bool foreignCharts() const { return foreignCharts_; }

 private:
  struct Corner {
    std::uint32_t source = 0;
    Vec3f position;
    Vec3f normal;  // of the file, in world directions; zero when it is missing or no direction
  };

  Corner corner(std::uint32_t vertex) const;
  void addTriangle(const std::array<std::uint32_t, 3>& vertices, std::uint32_t material);
  std::uint32_t addVertex(const Corner& corner, Vec3f normal);
  std::uint32_t sharedOrNew(const Corner& corner);
  void addUv(const std::optional<Accessor>& accessor, std::uint32_t vertex, std::vector<Vec2f>& into) const;
  std::uint32_t chartOf(const std::array<std::uint32_t, 3>& vertices);

  const GltfSource& source_;
  const WorldNode& node_;
  PrimitiveUse use_;
  const Json& json_;
  Affine normalMap_;
  std::optional<Accessor> positions_, normals_, uv0_, uv1_, atlasUv_, charts_;
  Scene& scene_;
  std::vector<std::uint32_t>& sharedVertex_;  // by source vertex; kNone outside of read()
  bool foreignCharts_ = false;
};

InstanceReader::InstanceReader(const GltfSource& source, const WorldNode& node, const PrimitiveUse& use,
                               const UvSlots& slots, Scene& scene, std::vector<std::uint32_t>& sharedVertex)
    : source_(source),
      node_(node),
      use_(use),
      json_(primitiveJson(source, use.mesh, use.primitive)),
      normalMap_(normalMap(node)),
      positions_(attributeOf(source, json_, "POSITION")),
      normals_(attributeOf(source, json_, "NORMAL")),
      uv0_(attributeOf(source, json_, "TEXCOORD_" + std::to_string(slots[0]))),
      uv1_(attributeOf(source, json_, "TEXCOORD_" + std::to_string(slots[1]))),
      atlasUv_(attributeOf(source, json_, "TEXCOORD_1")),
      charts_(attributeOf(source, json_, "_CHART")),
      scene_(scene),
      sharedVertex_(sharedVertex) {}

void InstanceReader::read(std::uint32_t material) {
  if (sharedVertex_.size() < positions_->count()) sharedVertex_.resize(positions_->count(), kNone);
  PrimitiveInstance instance{};
  instance.node = use_.node;
  instance.texelsPerMetre = node_.texelsPerMetre;
  instance.mesh = use_.mesh;
  instance.primitive = use_.primitive;
  instance.firstTriangle = static_cast<std::uint32_t>(scene_.triangles.size());
  instance.firstVertex = static_cast<std::uint32_t>(scene_.positions.size());
  for (std::array<std::uint32_t, 3> vertices : sourceTriangles(source_, use_.mesh, use_.primitive)) {
    if (node_.mirrors) std::swap(vertices[1], vertices[2]);
    addTriangle(vertices, material);
  }
  instance.triangleCount = static_cast<std::uint32_t>(scene_.triangles.size()) - instance.firstTriangle;
  instance.vertexCount = static_cast<std::uint32_t>(scene_.positions.size()) - instance.firstVertex;
  scene_.instances.push_back(instance);
  for (std::size_t v = instance.firstVertex; v < scene_.sourceVertex.size(); ++v) {
    sharedVertex_[scene_.sourceVertex[v]] = kNone;
  }
}

void InstanceReader::addTangents(const TextureUse& normalMap) {
  const auto given = attributeOf(source_, json_, "TANGENT");
  if (given && given->hasData() && normals_) {
    readTangents(*given, node_, scene_);
  } else {
    computeTangents(scene_, normalMap);
  }
}

InstanceReader::Corner InstanceReader::corner(std::uint32_t vertex) const {
  Corner c;
  c.source = vertex;
  c.position = localPosition(scene_.frame, worldPosition(*positions_, node_.world, vertex, source_, use_));
  if (normals_) {
    const Vec3d own = vector3(*normals_, vertex);
    // Two steps, so that neither tiny nor huge normals are lost in the squares.
    const double size = std::max({std::fabs(own.x), std::fabs(own.y), std::fabs(own.z)});
    const Vec3d n = size > 0 && std::isfinite(size) ? normalize(normalMap_.vector(own / size)) : Vec3d{};
    if (isFinite(n)) c.normal = Vec3f(n);
  }
  return c;
}

/// A triangle keeps the vertex normals of the file where all three are directions on the side of its front; else its
/// corners get the geometric normal and are shared with no other triangle.
void InstanceReader::addTriangle(const std::array<std::uint32_t, 3>& vertices, std::uint32_t material) {
  const std::array<Corner, 3> corners = {corner(vertices[0]), corner(vertices[1]), corner(vertices[2])};
  const Vec3d a(corners[0].position), b(corners[1].position), c(corners[2].position);
  const Vec3f geometric(normalize(cross(b - a, c - a)));
  const bool degenerate = geometric == Vec3f{};
  double least = 1;
  bool missing = false;
  for (const Corner& k : corners) {
    missing |= k.normal == Vec3f{};
    least = std::min(least, dot(Vec3d(k.normal), Vec3d(geometric)));
  }
  const bool own = !missing && (degenerate || least > kLeastCosine);
  const Vec3f flat = degenerate ? Vec3f{0, 1, 0} : geometric;
  Triangle triangle{{}, material};
  for (std::size_t k = 0; k < 3; ++k) triangle.v[k] = own ? sharedOrNew(corners[k]) : addVertex(corners[k], flat);
  scene_.triangles.push_back(triangle);
  scene_.smooth.push_back(own && !degenerate && least < kSmoothCosine);
  scene_.chartOfTriangle.push_back(chartOf(vertices));
}

std::uint32_t InstanceReader::sharedOrNew(const Corner& c) {
  std::uint32_t& shared = sharedVertex_[c.source];
  if (shared == kNone) shared = addVertex(c, c.normal);
  return shared;
}

std::uint32_t InstanceReader::addVertex(const Corner& c, Vec3f normal) {
  scene_.positions.push_back(c.position);
  scene_.normals.push_back(normal);
  scene_.sourceVertex.push_back(c.source);
  addUv(uv0_, c.source, scene_.uv0);
  addUv(uv1_, c.source, scene_.uv1);
  addUv(atlasUv_, c.source, scene_.atlasUv);
  return static_cast<std::uint32_t>(scene_.positions.size() - 1);
}

/// Sets that no primitive has data for stay empty; vertices of primitives without one get zeros.
void InstanceReader::addUv(const std::optional<Accessor>& accessor, std::uint32_t vertex,
                           std::vector<Vec2f>& into) const {
  if (!accessor || !accessor->hasData()) return;
  into.resize(scene_.positions.size());
  const double u = accessor->value(vertex, 0), v = accessor->value(vertex, 1);
  if (!(std::fabs(u) < 1e30 && std::fabs(v) < 1e30)) {
    primitivePlace(source_, use_.mesh, use_.primitive)
        .fail("vertex " + std::to_string(vertex) + " has texture coordinates that are not finite");
  }
  into.back() = {static_cast<float>(u), static_cast<float>(v)};
}

std::uint32_t InstanceReader::chartOf(const std::array<std::uint32_t, 3>& vertices) {
  if (!charts_) return kNone;
  const double chart = charts_->value(vertices[0], 0);
  bool ours = chart >= -1 && chart <= kMaxChart && chart == std::floor(chart);
  for (const std::uint32_t v : vertices) ours = ours && charts_->value(v, 0) == chart;
  foreignCharts_ |= !ours;
  return ours && chart >= 0 ? static_cast<std::uint32_t>(chart) : kNone;
}

bool hasCharts(const GltfSource& source, const std::vector<PrimitiveUse>& uses) {
  return std::any_of(uses.begin(), uses.end(), [&](const PrimitiveUse& use) {
    return primitiveJson(source, use.mesh, use.primitive)["attributes"].contains("_CHART");
  });
}

}  // namespace

Box trianglesBox(const GltfSource& source, const std::vector<WorldNode>& nodes, const std::vector<PrimitiveUse>& uses) {
  Box box;
  for (const PrimitiveUse& use : uses) {
    const auto positions = attributeOf(source, primitiveJson(source, use.mesh, use.primitive), "POSITION");
    for (const auto& triangle : sourceTriangles(source, use.mesh, use.primitive)) {
      for (const std::uint32_t v : triangle)
        box.add(worldPosition(*positions, nodes[use.worldNode].world, v, source, use));
    }
  }
  return box;
}

void readGeometry(const GltfSource& source, const std::vector<WorldNode>& nodes, const std::vector<PrimitiveUse>& uses,
                  const GltfMaterials& materials, Scene& scene) {
  std::vector<std::uint32_t> sharedVertex;
  bool foreignCharts = false;
  for (const PrimitiveUse& use : uses) {
    const Json* index = findMember(primitiveJson(source, use.mesh, use.primitive), "material");
    const std::size_t material = index == nullptr ? materials.materials.size() - 1 : index->get<std::size_t>();
    InstanceReader reader(source, nodes[use.worldNode], use, materials.uvSlots[material], scene, sharedVertex);
    reader.read(static_cast<std::uint32_t>(material));
    const TextureUse& normalMap = materials.materials[material].normalTexture;
    if (normalMap) reader.addTangents(normalMap);
    foreignCharts |= reader.foreignCharts();
  }
  for (std::vector<Vec2f>* uv : {&scene.uv0, &scene.uv1, &scene.atlasUv}) {
    if (!uv->empty()) uv->resize(scene.positions.size());
  }
  if (!scene.tangents.empty()) fillTangents(scene);
  if (foreignCharts) scene.leftOut.emplace_back("vertex attribute _CHART: does not hold chart numbers, ignored");
  if (foreignCharts || !hasCharts(source, uses)) scene.chartOfTriangle.clear();
}

}  // namespace lucarne
