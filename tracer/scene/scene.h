// The scene as plain data: what the tracer, the charts and the player read. Filled by gltf_reader.h.
//
// Local space. Positions are kept in a local frame, metres = origin + scale · local, with `scale` a power of two chosen
// so that the scene's largest extent lies in [1, 2) local units and `origin` its centre. Microns, kilometres and scenes
// far from the origin so share one code path, and a scene scaled by two gives the same bits. All lengths and areas
// here are local; all photometric quantities are the file's own SI units (cd, lx, cd/m²).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/vec.h"

namespace lucarne {

struct GltfSource;  // gltf_source.h: the file as read, so that it can be written again with everything in it

inline constexpr std::uint32_t kNone = 0xffffffffu;

struct LocalFrame {
  Vec3d origin{};    // metres
  double scale = 1;  // metres per local unit, a power of two
  Vec3d toLocal(Vec3d metres) const { return (metres - origin) * (1 / scale); }
  Vec3d toWorld(Vec3d local) const { return origin + local * scale; }
};

/// 8-bit image, RGBA, top row first (glTF: v = 0 is the top).
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

enum class Wrap : std::uint8_t { repeat, mirroredRepeat, clampToEdge };

struct Texture {
  std::uint32_t image = kNone;
  Wrap wrapS = Wrap::repeat, wrapT = Wrap::repeat;
  bool nearest = false;  // magnification filter
};

/// A use of a texture by a material. Coordinates: (u', v') = m · (u, v) + offset (KHR_texture_transform; identity if
/// absent).
struct TextureUse {
  std::uint32_t texture = kNone;
  std::uint8_t uvSet = 0;  // 0 or 1
  Vec2f rowU{1, 0}, rowV{0, 1}, offset{0, 0};
  explicit operator bool() const { return texture != kNone; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// glTF metallic-roughness with the extensions that the tracer models. Values are in range (the reader clamps).
struct Material {
  std::string name;
  Rgb baseColor{1.f};           // linear factor
  TextureUse baseColorTexture;  // sRGB; its alpha multiplies `alpha`
  AlphaMode alphaMode = AlphaMode::opaque;
  float alpha = 1;           // baseColorFactor[3]
  float alphaCutoff = 0.5f;  // of masks: below it there is no surface
  bool unlit = false;        // KHR_materials_unlit: takes no light and gives none
  float metallic = 1, roughness = 1;
  TextureUse metallicRoughnessTexture;  // linear; g = roughness, b = metallic
  Rgb emissive{0.f};                    // cd/m², emissiveFactor · KHR_materials_emissive_strength
  TextureUse emissiveTexture;           // sRGB, multiplies `emissive`
  TextureUse normalTexture;             // linear; tangent space, +y up
  float normalScale = 1;                // of its x and y
  float specular = 1;                   // KHR_materials_specular: specularFactor
  TextureUse specularTexture;           //   its alpha multiplies `specular`
  Rgb specularColor{1.f};               //   and specularColorFactor
  TextureUse specularColorTexture;      //   sRGB
  float ior = 1.5f;                     // KHR_materials_ior; 0 stands for an infinite index
  float transmission = 0;               // KHR_materials_transmission
  TextureUse transmissionTexture;       //   linear; its red multiplies `transmission`
  bool solid = false;         // KHR_materials_volume, thicknessFactor > 0: bounds a refracting volume; else a thin wall
  Rgb attenuationColor{1.f};  //   what is left of white light after attenuationDistance
  double attenuationDistance = 0;  //   metres; 0: a clear volume
  bool doubleSided = false;

  bool emits() const { return maxComponent(emissive) > 0 && !unlit; }
  bool transmits() const { return transmission > 0 && !unlit; }
  /// False where alpha is 1 everywhere or ignored.
  bool hasAlpha() const { return alphaMode != AlphaMode::opaque && !unlit; }
  bool stopsLight() const { return !hasAlpha() && !transmits(); }
};

struct Triangle {
  std::uint32_t v[3];
  std::uint32_t material;
};

enum class LightKind : std::uint8_t { point, spot, directional };

/// KHR_lights_punctual. `intensity`: cd for point and spot (on the axis), lx on a perpendicular plane for directional.
struct Light {
  std::string name;
  LightKind kind = LightKind::point;
  Rgb intensity{1.f};
  Vec3d position{};           // local
  Vec3d direction{0, 0, -1};  // unit, the way the light travels
  double cosInner = 1, cosOuter = 0.70710678118654752;
};

/// Perspective camera: looks along −z of its frame, y up. Axes are unit; position local.
struct Camera {
  std::string name;
  Vec3d position{}, right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};
  double yfov = 0.8;  // radians
};

/// Where a run of triangles comes from in the file; triangles and vertices of one instance are contiguous.
struct PrimitiveInstance {
  std::uint32_t node, mesh, primitive;
  std::uint32_t firstTriangle, triangleCount;
  std::uint32_t firstVertex, vertexCount;
  double texelsPerMetre = 0;  // density of its light maps where the file asks for one; 0: that of the bake
};

struct Scene {
  LocalFrame frame;

  // Vertices, one set an instance. normals are unit and on the side of the front face; empty uv0/uv1 mean none in file.
  std::vector<Vec3f> positions;  // local
  std::vector<Vec3f> normals;
  std::vector<Vec2f> uv0, uv1;
  // TEXCOORD_1 of the file: the scene's own unwrapping for light maps or, with chartOfTriangle, the place in the
  // irradiance atlas. The same as uv1 unless a material takes another set for its second; empty means none in file.
  std::vector<Vec2f> atlasUv;
  // Tangents of normal maps, by vertex: xyz unit in the plane of the normal, w = ±1 the sign of the bitangent
  // cross(normal, xyz) · w. Empty where no material has a normal map.
  std::vector<Vec4f> tangents;
  std::vector<std::uint32_t> sourceVertex;  // index into the source primitive's accessors

  // Triangles, counter-clockwise from the front (mirroring transforms already undone). Degenerate ones are kept, so
  // that triangle i of a scene written and read again is triangle i. smooth[i]: the vertex normals of i differ from
  // its geometric normal, so shading interpolates them.
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> smooth;

  // By triangle: 1 = without area, or a duplicate of an earlier triangle, whatever its material: the same three corner
  // positions with the same front. Light treats it as absent. Filled by scene_cleanup.h; empty means none is.
  std::vector<std::uint8_t> skipped;
  std::size_t degenerateTriangles = 0, duplicateTriangles = 0;  // of `skipped`, each triangle in one of them

  std::vector<Material> materials;  // at least one
  std::vector<Texture> textures;
  std::vector<Image> images;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<PrimitiveInstance> instances;

  // Of a scene.glb that we wrote: the chart of each triangle (kNone for degenerate ones), else empty. atlasUv is
  // then the place in the irradiance atlas.
  std::vector<std::uint32_t> chartOfTriangle;

  std::vector<std::string> leftOut;          // what the file has and we do not model, each once
  std::shared_ptr<const GltfSource> source;  // null for scenes made in memory

  Vec3f corner(std::uint32_t triangle, int k) const { return positions[triangles[triangle].v[k]]; }
  /// Twice the area times the unit geometric normal of the front.
  Vec3d scaledNormal(std::uint32_t triangle) const {
    const Vec3d a(corner(triangle, 0)), b(corner(triangle, 1)), c(corner(triangle, 2));
    return cross(b - a, c - a);
  }
};

}  // namespace lucarne
