// All light sources of a scene, picked in proportion to flux: emissive triangles, point, spot and directional lights,
// and the environment.
//
// An emitted photon carries `beta`: its flux as a fraction of totalFlux(), E[Σ beta / N] = emitted flux / totalFlux.
// Picking uses a cumulative table with a guide (Chen and Asau 1974): O(1) and order-preserving, so that neighbouring
// numbers pick neighbouring emitters. A triangle with an emissive texture is split until its pieces are a few texels
// wide, each with its own weight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/optics/cumulative.h"
#include "tracer/optics/emission_guide.h"
#include "tracer/optics/environment.h"
#include "tracer/optics/sampler.h"
#include "tracer/optics/surface.h"
#include "tracer/optics/warp.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct EmittedPhoton {
  Vec3d position;          // local
  Vec3f direction;         // of travel, unit
  Rgb beta;                // mean over channels about 1
  std::uint32_t triangle;  // kNone for lights
  Vec3f normal;            // of the emitting side; zero for lights
};

/// Numbers in [0, 1) for a photon of a chosen emitter: side of a two-sided face, place on it (or on the disc that light
/// from far away comes from), direction.
struct EmissionPlace {
  float side;
  Vec2f position, direction;
};

class EmitterTable {
 public:
  static constexpr std::uint32_t kSky = kNone - 1;

  struct Emitter {                // a light, a piece of a face, or the environment
    double flux;                  // weight, lm (mean over channels)
    double beta;                  // of a photon, per unit of radiance where it starts
    std::uint32_t face;           // into faces_; kNone: light
    std::uint32_t light;          // into the scene's lights; kSky: the environment
    Vec2f bary0, edge1, edge2;    // corner and edges of the piece in barycentrics of the face
    std::uint32_t guide = kNone;  // into guides_
    std::uint32_t plain = kNone;  // into plainFaces_: of a face that shines the same everywhere
  };
  struct Face {  // what all pieces of one emissive triangle share
    Vec3f p0, e1, e2, n;
    Rgb radiance;  // cd/m², where it is the same everywhere
    std::uint32_t triangle;
    std::uint32_t firstEmitter, cuts;  // its cuts² pieces, in the order of pieceAt()
    bool textured, twoSided;
  };

  /// All must outlive the table; no environment (null) is a black one.
  EmitterTable(const Scene& scene, const SurfaceTable& surfaces, const Environment* environment = nullptr);

  bool empty() const { return cumulative_.empty(); }
  std::size_t size() const { return emitters_.size(); }
  /// lm, mean over channels; the scale of beta.
  double totalFlux() const { return totalFlux_; }
  /// What is left of the number that picks the emitter is used for its first place: photons of one emitter are then as
  /// well spread as those of all.
  [[gnu::always_inline]] EmittedPhoton sample(const EmissionNumbers& u) const {
    const Choice choice = choose(cumulative_, guide_, u.pick);
    const Emitter& e = emitters_[choice.index];
    if (e.plain == kNone) return sample(choice, u.others);
    return emitFromPlain(plainFaces_[e.plain], choice.rest, u.others);
  }
  /// From a chosen emitter, whatever its guide; beta as if all photons came from it.
  EmittedPhoton sampleUnguided(std::size_t emitter, const EmissionPlace& u) const;
  /// How `rest` and `others` are dealt out for a chosen emitter.
  EmissionPlace placeFor(std::size_t emitter, double rest, const std::array<float, 3>& others) const;
  /// Light from far away: suns and the environment, which guides are made for.
  bool isDistant(std::size_t emitter) const;
  /// "the light 'Sun'", "the sky in SKY.hdr", for people.
  std::string nameOf(std::size_t emitter) const;
  /// Photons of a distant emitter follow the guide from now on.
  void setGuide(std::size_t emitter, EmissionGuide guide);
  const std::vector<EmissionGuide>& guides() const { return guides_; }
  const Emitter& emitter(std::size_t i) const { return emitters_[i]; }
  const Face& face(std::size_t i) const { return faces_[i]; }
  std::size_t faceCount() const { return faces_.size(); }
  const Environment* environment() const { return environment_; }
  /// The emitter that a number in [0, 1) picks; emitter i owns an interval as long as its share of the flux.
  std::size_t pick(double u) const;
  /// Which of a face's pieces holds barycentrics b.
  static std::uint32_t pieceAt(const Face& face, Vec2f b);
  /// Emitters but the environment, which is the last one where there is one.
  std::size_t localCount() const { return emitters_.size() - (hasSky() ? 1 : 0); }
  bool hasSky() const { return !emitters_.empty() && emitters_.back().light == kSky; }
  /// Emitters that give nothing: names of lights with zero intensity. For warnings.
  const std::vector<std::string>& dark() const { return dark_; }
  /// What each source gives, summing to totalFlux(): calls f(triangle, light, flux in lm, mean over channels), with
  /// kNone for the one that it is not. A triangle comes once for each of its pieces.
  template <class F>
  void forEachSource(F&& f) const {
    for (const Emitter& e : emitters_) f(e.face == kNone ? kNone : faces_[e.face].triangle, e.light, e.flux);
  }

 private:
  /// A face without textures, in the form that photons are made from.
  struct PlainFace {
    std::array<Frame<float>, 2> frames;  // around the normals of front and back
    Vec3f p0, e1, e2;
    Rgb beta;
    std::uint32_t triangle;
    bool twoSided;
  };
  /// See emitFromTriangle().
  [[gnu::always_inline]] static EmittedPhoton emitFromPlain(const PlainFace& f, double rest,
                                                            const std::array<float, 3>& others) {
    const EmissionPlace u = placeOnFace(f.twoSided, rest, others);
    const Vec2f b = sampleTriangle(u.position);
    const Frame<float>& frame = f.frames[f.twoSided && u.side < 0.5f ? 1 : 0];
    return {Vec3d(f.p0) + Vec3d(f.e1) * static_cast<double>(b.x) + Vec3d(f.e2) * static_cast<double>(b.y),
            frame.toWorld(sampleCosineHemisphere(u.direction)), f.beta, f.triangle, frame.n};
  }
  [[gnu::always_inline]] static EmissionPlace placeOnFace(bool twoSided, double rest,
                                                          const std::array<float, 3>& others) {
    if (!twoSided) return {0, {belowOne(rest), others[0]}, {others[1], others[2]}};
    const double half = 2 * rest;
    return {belowOne(rest), {belowOne(half < 1 ? half : half - 1), others[0]}, {others[1], others[2]}};
  }
  static float belowOne(double u) { return std::min(static_cast<float>(u), 1 - 0x1p-24f); }

  EmittedPhoton sample(const Choice& choice, const std::array<float, 3>& others) const;
  void addPlain();
  void addTriangle(std::uint32_t triangle);
  void addLight(std::uint32_t index);
  void addEnvironment();
  void buildTable();
  int subdivisions(std::uint32_t triangle) const;
  int subdivisions(std::uint32_t triangle, const TextureUse& use) const;
  EmittedPhoton emitFromTriangle(const Emitter& e, const EmissionPlace& u) const;
  EmittedPhoton emitFromLight(const Emitter& e, const EmissionPlace& u) const;
  EmittedPhoton emitFromSky(const EmissionPlace& u) const;
  EmittedPhoton fromDisc(Vec3f direction, Vec2f u, Rgb beta) const;

  const Scene* scene_;
  const SurfaceTable* surfaces_;
  const Environment* environment_;
  Vec3d center_{};  // bounding sphere of the scene, local
  double radius_ = 0;
  std::vector<Emitter> emitters_;
  std::vector<Face> faces_;
  std::vector<PlainFace> plainFaces_;
  std::vector<EmissionGuide> guides_;
  std::vector<double> cumulative_;    // [i] = Σ flux of 0..i, divided by the total
  std::vector<std::uint32_t> guide_;  // guide_[k]: first i with cumulative_[i] > k/size
  double totalFlux_ = 0;
  std::vector<std::string> dark_;
};

}  // namespace lucarne
