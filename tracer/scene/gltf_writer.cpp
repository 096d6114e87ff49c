#include "tracer/scene/gltf_writer.h"

#include "base/error.h"
#include "tracer/scene/gltf_embed.h"
#include "tracer/scene/gltf_mend.h"
#include "tracer/scene/gltf_nodes.h"
#include "tracer/scene/gltf_plain_source.h"
#include "tracer/scene/gltf_primitive_writer.h"
#include "tracer/scene/gltf_primitives.h"

namespace lucarne {
namespace {

class SceneWriter {
 public:
  SceneWriter(const GltfSource& source, std::span<const PrimitiveInstance> instances, const AtlasUv& uv)
      : source_(source), instances_(instances), uv_(uv), json_(source.json) {}
  std::vector<std::uint8_t> write();

 private:
  void giveNodesTheirMeshes();
  void takeOutGeometry();
  void writePrimitives(GltfDocument& document);
  void fillOtherPrimitives(GltfDocument& document);
  Json& primitiveOf(Json& json, std::size_t instance) const {
    return json["meshes"][meshOf_[instance]]["primitives"][instances_[instance].primitive];
  }

  const GltfSource& source_;
  std::span<const PrimitiveInstance> instances_;
  const AtlasUv& uv_;
  Json json_;
  std::vector<std::uint32_t> meshOf_;  // by instance: its mesh in the new document
  std::vector<Json> originals_;        // by instance: the primitive before its geometry was taken out
};

std::vector<std::uint8_t> SceneWriter::write() {
  mendDocument(json_);
  freeTexcoord1(json_);
  giveNodesTheirMeshes();
  takeOutGeometry();
  const UsedReferences used = usedReferences(json_);
  GltfDocument document(std::move(json_), source_, used);
  embedImages(source_, document);
  writePrimitives(document);
  fillOtherPrimitives(document);
  return document.finish();
}

/// A mesh that several nodes of the document share is copied for all but the last of them.
void SceneWriter::giveNodesTheirMeshes() {
  std::vector<std::uint32_t> usesLeft(json_["meshes"].size(), 0);
  for (const Json& node : json_["nodes"]) {
    if (node.contains("mesh")) ++usesLeft[node["mesh"].get<std::uint32_t>()];
  }
  std::uint32_t node = kNone, mesh = kNone;
  for (const PrimitiveInstance& instance : instances_) {
    if (instance.node != node) {
      node = instance.node;
      mesh = instance.mesh;
      if (usesLeft[mesh]-- > 1) {
        Json copy = json_["meshes"][mesh];
        json_["meshes"].push_back(std::move(copy));
        mesh = static_cast<std::uint32_t>(json_["meshes"].size() - 1);
        json_["nodes"][node]["mesh"] = mesh;
      }
    }
    meshOf_.push_back(mesh);
  }
}

void SceneWriter::takeOutGeometry() {
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    Json& primitive = primitiveOf(json_, i);
    originals_.push_back(primitive);
    primitive["attributes"] = Json::object();
    primitive.erase("indices");
    primitive.erase("targets");
  }
}

void SceneWriter::writePrimitives(GltfDocument& document) {
  const std::vector<WorldNode> nodes = flattenNodes(source_.json, source_.place());
  std::vector<std::uint8_t> mirrors(source_.list("nodes").size(), 0);
  for (const WorldNode& n : nodes) mirrors[n.node] = n.mirrors;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const PrimitiveInstance& instance = instances_[i];
    const auto triangles = sourceTriangles(source_, instance.mesh, instance.primitive);
    LUCARNE_CHECK_EQ(triangles.size(), std::size_t{instance.triangleCount});
    const SplitVertices split = splitVertices(triangles, instance.firstTriangle, mirrors[instance.node] != 0, uv_);
    writePrimitive(source_, originals_[i], split, document, primitiveOf(document.json(), i));
  }
}

/// Primitives outside of the scene keep their geometry, but a set of theirs may have moved.
void SceneWriter::fillOtherPrimitives(GltfDocument& document) {
  for (Json& mesh : document.json()["meshes"]) {
    if (!mesh.contains("primitives")) continue;
    for (Json& primitive : mesh["primitives"]) {
      Json& attributes = primitive["attributes"];
      if (!attributes.contains("TEXCOORD_2") || !attributes.contains("POSITION")) continue;
      const auto position = attributes["POSITION"].get<std::size_t>();
      const auto count = document.json()["accessors"][position]["count"].get<std::uint64_t>();
      fillTexcoordGaps(attributes, count, document);
    }
  }
}

}  // namespace

std::vector<std::uint8_t> writeSceneGlb(const Scene& scene, const AtlasUv& uv) {
  LUCARNE_CHECK_EQ(uv.corner.size(), scene.triangles.size());
  LUCARNE_CHECK_EQ(uv.chartOfTriangle.size(), scene.triangles.size());
  for (const std::uint32_t chart : uv.chartOfTriangle) {
    if (chart != kNone) LUCARNE_CHECK_LT(chart, std::uint32_t{1} << 24);
  }
  if (scene.source != nullptr) return SceneWriter(*scene.source, scene.instances, uv).write();
  const PlainSource plain = plainSource(scene);
  return SceneWriter(*plain.source, plain.instances, uv).write();
}

}  // namespace lucarne
