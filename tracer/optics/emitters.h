// All light sources of a scene, picked in proportion to flux: emissive triangles, point, spot and directional lights.
//
// An emitted photon carries `beta`: its flux as a fraction of totalFlux(), E[Σ beta / N] = emitted flux / totalFlux.
// Picking uses a cumulative table with a guide (Chen and Asau 1974): O(1) and order-preserving, so that neighbouring
// numbers pick neighbouring emitters. A triangle with an emissive texture is split until its pieces are a few texels
// wide, each with its own weight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/optics/surface.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct EmittedPhoton {
  Vec3d position;          // local
  Vec3f direction;         // of travel, unit
  Rgb beta;                // mean over channels about 1
  std::uint32_t triangle;  // kNone for lights
  Vec3f normal;            // of the emitting side; zero for lights
};

/// Six numbers in [0, 1): pick (double), side or spare, position, direction.
struct EmissionSample {
  double pick;
  float side;
  Vec2f position, direction;
};

class EmitterTable {
 public:
  /// `surfaces` must outlive the table.
  EmitterTable(const Scene& scene, const SurfaceTable& surfaces);

  bool empty() const { return cumulative_.empty(); }
  std::size_t size() const { return emitters_.size(); }
  /// lm, mean over channels; the scale of beta.
  double totalFlux() const { return totalFlux_; }
  EmittedPhoton sample(const EmissionSample& u) const;
  /// Emitters that give nothing: names of lights with zero intensity. For warnings.
  const std::vector<std::string>& dark() const { return dark_; }

 private:
  struct Emitter {       // a light, or a piece of a face
    double flux;         // weight, lm (mean over channels)
    double beta;         // of a photon, per unit of radiance where it starts
    std::uint32_t face;  // into faces_; kNone: light
    std::uint32_t light;
    Vec2f bary0, edge1, edge2;  // corner and edges of the piece in barycentrics of the face
  };
  struct Face {  // what all pieces of one emissive triangle share
    Vec3f p0, e1, e2, n;
    Rgb radiance;  // cd/m², where it is the same everywhere
    std::uint32_t triangle;
    bool textured, twoSided;
  };
  void addTriangle(std::uint32_t triangle);
  void addLight(std::uint32_t index);
  void buildTable();
  int subdivisions(std::uint32_t triangle) const;
  std::size_t pick(double u) const;
  EmittedPhoton emitFromTriangle(const Emitter& e, const EmissionSample& u) const;
  EmittedPhoton emitFromLight(const Emitter& e, const EmissionSample& u) const;

  const Scene* scene_;
  const SurfaceTable* surfaces_;
  Vec3d center_{};  // bounding sphere of the scene, local
  double radius_ = 0;
  std::vector<Emitter> emitters_;
  std::vector<Face> faces_;
  std::vector<double> cumulative_;    // [i] = Σ flux of 0..i, divided by the total
  std::vector<std::uint32_t> guide_;  // guide_[k]: first i with cumulative_[i] > k/size
  double totalFlux_ = 0;
  std::vector<std::string> dark_;
};

}  // namespace lucarne
