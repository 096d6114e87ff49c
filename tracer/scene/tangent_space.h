// Tangents for normal maps: the frame in which a map's vectors stand, (tangent, bitangent, normal) with the tangent
// along +u and the bitangent along −v, which is up in the image, for glTF's v points down.
#pragma once

#include "tracer/scene/scene.h"

namespace lucarne {

/// Some unit tangent in the plane of a unit normal, w = 1.
Vec4f anyTangent(Vec3f normal);

/// Unit vector along the part of `direction` in the plane of the unit normal; zero where there is none to speak of.
Vec3d inPlane(Vec3d direction, Vec3f normal);

/// Brings Scene::tangents to the length of positions with anyTangent().
void fillTangents(Scene& scene);

/// Computes the tangents of the scene's last instance from positions, normals and the texture coordinates of
/// `normalMap`, its transform applied. As in MikkTSpace (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited",
/// section 4): the mean over the triangles that share a point, each weighed by its angle there in the plane of the
/// normal. A point is a position with its normal and texture coordinates, so how vertices are shared or split does not
/// matter. Triangles with mirrored texture coordinates do not mix with others: where both meet at one vertex, it is
/// split, and the new one appended to the scene and the instance. Unlike MikkTSpace, triangles of one point and one
/// orientation mix whether or not they share an edge. Where texture coordinates are missing or degenerate,
/// anyTangent().
void computeTangents(Scene& scene, const TextureUse& normalMap);

}  // namespace lucarne
