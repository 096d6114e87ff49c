#include "player/scene_upload.h"

#include <cstddef>

#include "base/error.h"
#include "tracer/optics/specular_table.h"

namespace lucarne {
namespace {

GlVertexArray vertexLayout(const GlBuffer& vertices) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  GlVertexArray layout(name);
  glVertexArrayVertexBuffer(name, 0, vertices.get(), 0, sizeof(GpuVertex));
  struct Attribute {
    GLint components;
    std::size_t offset;
  };
  constexpr Attribute floats[] = {{3, offsetof(GpuVertex, position)},
                                  {3, offsetof(GpuVertex, normal)},
                                  {2, offsetof(GpuVertex, uv0)},
                                  {2, offsetof(GpuVertex, uv1)},
                                  {2, offsetof(GpuVertex, chartUv)}};
  GLuint index = 0;
  for (const Attribute& a : floats) {
    glVertexArrayAttribFormat(name, index, a.components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(a.offset));
    ++index;
  }
  glVertexArrayAttribIFormat(name, index, 2, GL_UNSIGNED_INT, offsetof(GpuVertex, frontSide));
  ++index;
  glVertexArrayAttribFormat(name, index, 4, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, tangent));
  for (GLuint i = 0; i <= index; ++i) {
    glVertexArrayAttribBinding(name, i, 0);
    glEnableVertexArrayAttrib(name, i);
  }
  return layout;
}

GlTexture uploadSpecularTable() {
  constexpr int n = SpecularTable::kSize;
  const SpecularTable& table = SpecularTable::instance();
  std::vector<Vec3f> nodes;
  for (int j = 0; j < n; ++j) {
    const float roughness = static_cast<float>(j) / (n - 1);
    const SpecularTable::Row row = table.row(roughness * roughness);
    const Vec2f mean = row.meanScaleBias();
    for (int i = 0; i < n; ++i) {
      const Vec2f sb = row.scaleBias(static_cast<float>(i) / (n - 1));
      nodes.push_back({sb.x, sb.y, mean.x + mean.y});
    }
  }
  GlTexture texture = makeTexture({GL_TEXTURE_2D, GL_RGB32F, 1, n, n, 1});
  glTextureSubImage2D(texture.get(), 0, 0, 0, n, n, GL_RGB, GL_FLOAT, nodes.data());
  return texture;
}

GlBuffer uploadMaterials(const Scene& scene) {
  std::vector<GpuMaterial> materials;
  for (const Material& m : scene.materials) materials.push_back(gpuMaterial(m));
  return makeBuffer(std::span<const GpuMaterial>(materials));
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, const LightMaps& maps) : list(buildDrawList(scene, maps)), textures(scene) {
  vertices = makeBuffer(std::span<const GpuVertex>(list.vertices));
  list.vertices = {};
  materials = uploadMaterials(scene);
  specularTable = uploadSpecularTable();
}

GLuint GpuScene::layout() {
  if (layout_.get() == 0) layout_ = vertexLayout(vertices);
  return layout_.get();
}

}  // namespace lucarne
