#include "tracer/optics/emitters.h"

#include <cmath>

#include "base/math.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {


/// Falloff of a spot at cosine c: ((c − cosOuter)/(cosInner − cosOuter))², 1 inside the inner cone
/// (KHR_lights_punctual). Its flux per unit of intensity is 2π[(1 − ci) + (ci − co)/3].
double spotFlux(const Light& l) { return 2 * kPiD * ((1 - l.cosInner) + (l.cosInner - l.cosOuter) / 3); }

/// Cosine distributed like the falloff, so that every photon carries the same flux: a share of the inner cone uniform
/// in cosine, the rest by inverting the cube of the ramp.
double sampleSpotCosine(const Light& l, double u) {
  const double inner = 1 - l.cosInner, ramp = (l.cosInner - l.cosOuter) / 3;
  const double x = u * (inner + ramp);
  if (x < inner || ramp <= 0) return 1 - std::min(x, inner);
  return l.cosOuter + (l.cosInner - l.cosOuter) * cbrt(std::max(0.0, 1 - (x - inner) / ramp));
}

Vec2f at(const std::array<Vec2f, 3>& corner, Vec2f b) {
  return corner[0] * (1 - b.x - b.y) + corner[1] * b.x + corner[2] * b.y;
}

/// The n² congruent pieces of a triangle cut n times along each edge, as corners in its barycentrics.
template <class F>
void forEachPiece(int n, F&& f) {
  const float h = 1.f / static_cast<float>(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const float x = static_cast<float>(i) * h, y = static_cast<float>(j) * h;
      f(std::array<Vec2f, 3>{Vec2f{x, y}, Vec2f{x + h, y}, Vec2f{x, y + h}});
      if (i + j + 1 < n) f(std::array<Vec2f, 3>{Vec2f{x + h, y + h}, Vec2f{x, y + h}, Vec2f{x + h, y}});
    }
  }
}

/// Sixteen centroids of a regular cut: the quadrature for the mean radiance of a piece.
template <class F>
double quadrature(const std::array<Vec2f, 3>& piece, F&& value) {
  double sum = 0;
  forEachPiece(4, [&](const std::array<Vec2f, 3>& cell) { sum += value(at(piece, at(cell, {1.f / 3, 1.f / 3}))); });
  return sum / 16;
}

constexpr std::array<Vec2f, 3> kWholeTriangle{Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{0, 1}};

}  // namespace

EmitterTable::EmitterTable(const Scene& scene, const SurfaceTable& surfaces, const Environment* environment)
    : scene_(&scene), surfaces_(&surfaces), environment_(environment) {
  Box box;
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : t.v) box.add(Vec3d(scene.positions[v]));
  if (!box.empty()) {
    center_ = box.center();
    radius_ = 0.5 * length(box.extent()) * (1 + 1e-4);  // a little more, for rounding
  }
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
    if (scene.materials[scene.triangles[i].material].emits() && !isSkipped(scene, i)) addTriangle(i);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) addLight(i);
  addEnvironment();
  buildTable();
}

int EmitterTable::subdivisions(std::uint32_t triangle) const {
  const Material& m = scene_->materials[scene_->triangles[triangle].material];
  return std::max(subdivisions(triangle, m.emissiveTexture),
                  m.hasAlpha() ? subdivisions(triangle, m.baseColorTexture) : 1);
}

int EmitterTable::subdivisions(std::uint32_t triangle, const TextureUse& use) const {
  if (!use || scene_->textures[use.texture].image == kNone) return 1;
  const auto& set = use.uvSet == 0 ? scene_->uv0 : scene_->uv1;
  if (set.empty()) return 1;
  const Image& image = scene_->images[scene_->textures[use.texture].image];
  const Triangle& t = scene_->triangles[triangle];
  float longest = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec2f d = set[t.v[(k + 1) % 3]] - set[t.v[k]];
    const Vec2f e{dot(use.rowU, d) * static_cast<float>(image.width),
                  dot(use.rowV, d) * static_cast<float>(image.height)};
    longest = std::max(longest, std::sqrt(dot(e, e)));
  }
  constexpr float kTexelsAPiece = 4, kMostCuts = 256;
  return static_cast<int>(std::clamp(std::ceil(longest / kTexelsAPiece), 1.f, kMostCuts));
}

void EmitterTable::addTriangle(std::uint32_t triangle) {
  const double s = scene_->frame.scale;
  const double area = 0.5 * length(scene_->scaledNormal(triangle)) * s * s;
  if (!(area > 0)) return;
  const Material& m = scene_->materials[scene_->triangles[triangle].material];
  const double sides = m.doubleSided ? 2 : 1;
  const auto radiance = [&](Vec2f b) { return static_cast<double>(mean(surfaces_->emission(triangle, b))); };
  const int n = subdivisions(triangle);
  const double pieceArea = area / (static_cast<double>(n) * n);
  const auto face = static_cast<std::uint32_t>(faces_.size());
  std::vector<Emitter> pieces;
  double total = 0;
  forEachPiece(n, [&](const std::array<Vec2f, 3>& corners) {
    const double value = n == 1 ? quadrature(kWholeTriangle, radiance) : quadrature(corners, radiance);
    pieces.push_back({value, 0, face, kNone, corners[0], corners[1] - corners[0], corners[2] - corners[0]});
    total += value;
  });
  if (!(total > 0)) return;
  // A tenth of the weight is spread evenly, so that no piece whose light slipped through the quadrature is left out.
  const double even = total / static_cast<double>(pieces.size());
  const auto firstEmitter = static_cast<std::uint32_t>(emitters_.size());
  for (Emitter& e : pieces) {
    const double value = pieces.size() == 1 ? e.flux : 0.9 * e.flux + 0.1 * even;
    e.flux = sides * kPiD * pieceArea * value;
    e.beta = sides * kPiD * pieceArea / e.flux;
    emitters_.push_back(e);
  }
  const Vec3f p0 = scene_->corner(triangle, 0);
  faces_.push_back({p0, scene_->corner(triangle, 1) - p0, scene_->corner(triangle, 2) - p0,
                    Vec3f(normalize(scene_->scaledNormal(triangle))), m.emissive, triangle, firstEmitter,
                    static_cast<std::uint32_t>(n), bool(m.emissiveTexture) || m.hasAlpha(), m.doubleSided});
  if (!faces_.back().textured) addPlain();
}

/// The face and emitter added last: a face without textures is one piece.
void EmitterTable::addPlain() {
  const Face& f = faces_.back();
  Emitter& e = emitters_.back();
  e.plain = static_cast<std::uint32_t>(plainFaces_.size());
  plainFaces_.push_back({{Frame<float>(f.n), Frame<float>(-f.n)}, f.p0, f.e1, f.e2, Rgb(Rgbd(f.radiance) * e.beta),
                         f.triangle, f.twoSided});
}

void EmitterTable::addLight(std::uint32_t index) {
  const Light& l = scene_->lights[index];
  const double intensity = mean(Rgbd(l.intensity));
  const double metres = radius_ * scene_->frame.scale;
  double flux = 0;
  switch (l.kind) {
    case LightKind::point:
      flux = 4 * kPiD * intensity;
      break;
    case LightKind::spot:
      flux = spotFlux(l) * intensity;
      break;
    case LightKind::directional:
      flux = kPiD * metres * metres * intensity;
      break;
  }
  if (!(flux > 0)) {
    dark_.push_back(l.name);
    return;
  }
  emitters_.push_back({flux, 0, kNone, index, {}, {}, {}});
}

/// Light of radiance L from all around crosses a disc of the bounding sphere's radius from each direction: π·R²·∫L dω.
void EmitterTable::addEnvironment() {
  if (environment_ == nullptr) return;
  const double metres = radius_ * scene_->frame.scale;
  const double flux = kPiD * metres * metres * mean(environment_->scalarIrradiance());
  if (flux > 0) {
    emitters_.push_back({flux, 0, kNone, kSky, {}, {}, {}});
  } else {
    dark_.push_back(environment_->name());
  }
}

void EmitterTable::buildTable() {
  for (const Emitter& e : emitters_) cumulative_.push_back(e.flux);
  totalFlux_ = makeCumulative(cumulative_);
  guide_.resize(cumulative_.size());
  makeGuide(cumulative_, guide_);
}

/// The inverse of forEachPiece(): before row i come i·(2n − i) pieces, in a row two a column but for the last.
std::uint32_t EmitterTable::pieceAt(const Face& face, Vec2f b) {
  const std::uint32_t n = face.cuts;
  const auto cell = [n](float x) {
    return std::min(static_cast<std::uint32_t>(std::max(0.f, x) * static_cast<float>(n)), n - 1);
  };
  const std::uint32_t i = cell(b.x), j = std::min(cell(b.y), n - 1 - i);
  const float x = b.x * static_cast<float>(n) - static_cast<float>(i),
              y = b.y * static_cast<float>(n) - static_cast<float>(j);
  const bool upper = x + y > 1 && i + j + 1 < n;
  return i * (2 * n - i) + 2 * j + (upper ? 1 : 0);
}

std::size_t EmitterTable::pick(double u) const { return choose(cumulative_, guide_, u).index; }

EmissionPlace EmitterTable::placeFor(std::size_t emitter, double rest, const std::array<float, 3>& others) const {
  const Emitter& e = emitters_[emitter];
  if (e.face == kNone) return {0, {others[1], others[2]}, {belowOne(rest), others[0]}};
  return placeOnFace(faces_[e.face].twoSided, rest, others);
}

EmittedPhoton EmitterTable::sample(const Choice& choice, const std::array<float, 3>& others) const {
  const Emitter& e = emitters_[choice.index];
  EmissionPlace place = placeFor(choice.index, choice.rest, others);
  if (e.guide == kNone) return sampleUnguided(choice.index, place);
  const EmissionGuide::Numbers guided = guides_[e.guide].warp(place.direction, place.position);
  EmittedPhoton photon = sampleUnguided(choice.index, {place.side, guided.place, guided.direction});
  photon.beta *= static_cast<float>(1 / guided.density);
  return photon;
}

EmittedPhoton EmitterTable::sampleUnguided(std::size_t emitter, const EmissionPlace& u) const {
  const Emitter& e = emitters_[emitter];
  if (e.face != kNone) return emitFromTriangle(e, u);
  return e.light == kSky ? emitFromSky(u) : emitFromLight(e, u);
}

bool EmitterTable::isDistant(std::size_t emitter) const {
  const Emitter& e = emitters_[emitter];
  return e.face == kNone && (e.light == kSky || scene_->lights[e.light].kind == LightKind::directional);
}

std::string EmitterTable::nameOf(std::size_t emitter) const {
  const Emitter& e = emitters_[emitter];
  if (e.face != kNone) return "triangle " + std::to_string(faces_[e.face].triangle);
  return e.light == kSky ? "the sky in " + environment_->name() : "the light '" + scene_->lights[e.light].name + "'";
}

void EmitterTable::setGuide(std::size_t emitter, EmissionGuide guide) {
  emitters_[emitter].guide = static_cast<std::uint32_t>(guides_.size());
  guides_.push_back(std::move(guide));
}

/// Position pdf 1/area, direction pdf cos/π, side pdf 1/sides, piece pdf flux/total:
/// beta = Le·cos / (pdf) / total = Le · π · area · sides / flux.
EmittedPhoton EmitterTable::emitFromTriangle(const Emitter& e, const EmissionPlace& u) const {
  const Face& f = faces_[e.face];
  const Vec2f p = sampleTriangle(u.position);
  const Vec2f b = e.bary0 + e.edge1 * p.x + e.edge2 * p.y;
  const Vec3f n = f.twoSided && u.side < 0.5f ? -f.n : f.n;
  const Vec3d position = Vec3d(f.p0) + Vec3d(f.e1) * static_cast<double>(b.x) + Vec3d(f.e2) * static_cast<double>(b.y);
  const Vec3f direction = Frame<float>(n).toWorld(sampleCosineHemisphere(u.direction));
  const Rgb radiance = f.textured ? surfaces_->emission(f.triangle, b) : f.radiance;
  return {position, direction, Rgb(Rgbd(radiance) * e.beta), f.triangle, n};
}

EmittedPhoton EmitterTable::emitFromLight(const Emitter& e, const EmissionPlace& u) const {
  const Light& l = scene_->lights[e.light];
  const Rgb beta(Rgbd(l.intensity) * (1 / mean(Rgbd(l.intensity))));
  const Frame<float> frame{Vec3f(l.direction)};
  switch (l.kind) {
    case LightKind::point:
      return {l.position, sampleSphere(u.direction), beta, kNone, {}};
    case LightKind::spot: {
      const auto c = static_cast<float>(sampleSpotCosine(l, static_cast<double>(u.direction.x)));
      return {l.position, normalize(frame.toWorld(directionAround(c, u.direction.y))), beta, kNone, {}};
    }
    case LightKind::directional:
      break;
  }
  return fromDisc(Vec3f(l.direction), u.position, beta);
}

/// The direction's density is mean(L)/∫mean(L): a photon carries L/mean(L).
EmittedPhoton EmitterTable::emitFromSky(const EmissionPlace& u) const {
  const Environment::Sample s =
      environment_->sample(static_cast<double>(u.direction.x), static_cast<double>(u.direction.y));
  return fromDisc(-s.direction, u.position, s.radiance * (1 / mean(s.radiance)));
}

/// From a disc that just covers the scene's bounding sphere, upstream of it.
EmittedPhoton EmitterTable::fromDisc(Vec3f direction, Vec2f u, Rgb beta) const {
  const Vec2f d = sampleDisc(u);
  const Vec3d offset(Frame<float>(direction).toWorld({d.x, d.y, -1.f}));
  return {center_ + offset * radius_, direction, beta, kNone, {}};
}

}  // namespace lucarne
