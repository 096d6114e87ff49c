// What evenly spread light leaves in each ψ where hits are shared among three ψ (direction_triangles.h): integrals of
// the weights, the "tents" over the triangles that meet at ψ, above a horizon.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "dlm/direction_triangles.h"

namespace lucarne {

/// Integrals over the sphere, or the part of it above a horizon, of the weight λ of one ψ.
struct TentIntegral {
  double solidAngle = 0;          // ∫ λ dω, sr
  Vec3d moment{};                 // ∫ λ ω dω
  std::array<Vec3d, 3> second{};  // ∫ λ ω ωᵀ dω, by row
  TentIntegral& operator+=(const TentIntegral& o);
  Vec3d secondAlong(Vec3d n) const { return {dot(second[0], n), dot(second[1], n), dot(second[2], n)}; }
};

class DirectionTents {
 public:
  /// Both must outlive this.
  DirectionTents(const std::vector<Vec3d>& directions, const DirectionTriangles& triangles);

  /// Of ψ above the plane of unit normal `n`, where a side of that normal has those members. Triangles of three members
  /// share their light, others give it to the nearest of those of their ψ that are members. To about 1e-5 of the whole.
  TentIntegral above(int psi, Vec3d n, const std::function<bool(int)>& isMember) const;

 private:
  TentIntegral cutTriangle(const DirectionTriangles::Triangle& t, std::size_t corner, Vec3d n,
                           const std::function<bool(int)>& isMember) const;

  const std::vector<Vec3d>& directions_;
  const DirectionTriangles& triangles_;
  std::vector<std::uint32_t> first_;                // of each ψ, into around_, and the end
  std::vector<std::uint32_t> around_;               // triangles of ψ
  std::vector<std::array<TentIntegral, 3>> whole_;  // of each triangle, by corner
};

}  // namespace lucarne
