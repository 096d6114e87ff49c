#include "tracer/optics/light_sampler.h"

#include <cmath>
#include <limits>

#include "tracer/optics/warp.h"

namespace lucarne {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3d pointOn(const EmitterTable::Face& f, Vec2f b) {
  return Vec3d(f.p0) + Vec3d(f.e1) * static_cast<double>(b.x) + Vec3d(f.e2) * static_cast<double>(b.y);
}

/// Share of a spot's intensity at cosine c (see spotFlux() in emitters.cpp).
double spotFalloff(const Light& l, double c) {
  if (c >= l.cosInner) return 1;
  if (c <= l.cosOuter) return 0;
  const double x = (c - l.cosOuter) / (l.cosInner - l.cosOuter);
  return x * x;
}

}  // namespace

LightSampler::LightSampler(const Scene& scene, const EmitterTable& emitters, const SurfaceTable& surfaces)
    : scene_(scene), emitters_(emitters), surfaces_(surfaces) {
  for (std::size_t i = 0; i < emitters.localCount(); ++i) localFlux_ += emitters.emitter(i).flux;
  if (emitters.faceCount() == 0) return;
  faceOfTriangle_.assign(scene.triangles.size(), kNone);
  for (std::uint32_t f = 0; f < emitters.faceCount(); ++f) faceOfTriangle_[emitters.face(f).triangle] = f;
}

std::optional<LightSample> LightSampler::sampleLocal(Vec3d from, const LightNumbers& u) const {
  if (emitters_.localCount() == 0) return std::nullopt;
  const std::size_t i =
      std::min(emitters_.pick(u.pick * localFlux_ / emitters_.totalFlux()), emitters_.localCount() - 1);
  return emitters_.emitter(i).face != kNone ? onTriangle(from, i, u.place) : atLight(from, i);
}

/// A piece is chosen by flux and a place on it uniformly: 1/area, brought to solid angle by d²/cos.
double LightSampler::pdfOnFace(Vec3d from, Vec3d at, const EmitterTable::Face& face, std::size_t emitter) const {
  const Vec3d d = from - at;
  const double distance2 = dot(d, d), cosine = dot(d, Vec3d(face.n)) / std::sqrt(distance2);
  if (!(face.twoSided ? cosine != 0 : cosine > 0)) return 0;
  const double area =
      0.5 * length(cross(Vec3d(face.e1), Vec3d(face.e2))) / (static_cast<double>(face.cuts) * face.cuts);
  return probability(emitter) * distance2 / (area * std::abs(cosine));
}

std::optional<LightSample> LightSampler::onTriangle(Vec3d from, std::size_t emitter, Vec2f u) const {
  const EmitterTable::Emitter& e = emitters_.emitter(emitter);
  const EmitterTable::Face& face = emitters_.face(e.face);
  const Vec2f p = sampleTriangle(u);
  const Vec2f b = e.bary0 + e.edge1 * p.x + e.edge2 * p.y;
  const Vec3d at = pointOn(face, b);
  const double pdf = pdfOnFace(from, at, face, emitter);
  if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
  const double distance = length(at - from);
  const Vec3f wi((at - from) / distance);
  const Rgb radiance = face.textured ? surfaces_.emission(face.triangle, b) : face.radiance;
  return LightSample{wi, distance, at, dot(wi, face.n) < 0 ? face.n : -face.n, face.triangle, Rgb(Rgbd(radiance) / pdf),
                     pdf};
}

std::optional<LightSample> LightSampler::atLight(Vec3d from, std::size_t emitter) const {
  const Light& l = scene_.lights[emitters_.emitter(emitter).light];
  const double chosen = probability(emitter);
  if (l.kind == LightKind::directional)
    return LightSample{-Vec3f(l.direction), kInfinity, {}, {}, kNone, Rgb(Rgbd(l.intensity) / chosen), 0};
  const Vec3d d = l.position - from;
  const double distance = length(d), metres = distance * scene_.frame.scale;
  if (!(distance > 0)) return std::nullopt;
  const double share = l.kind == LightKind::spot ? spotFalloff(l, dot(d, l.direction) / -distance) : 1;
  if (!(share > 0)) return std::nullopt;
  return LightSample{Vec3f(d / distance),
                     distance,
                     l.position,
                     {},
                     kNone,
                     Rgb(Rgbd(l.intensity) * (share / (metres * metres * chosen))),
                     0};
}

double LightSampler::pdfLocal(Vec3d from, std::uint32_t triangle, Vec2f b) const {
  if (faceOfTriangle_.empty() || faceOfTriangle_[triangle] == kNone) return 0;
  const EmitterTable::Face& face = emitters_.face(faceOfTriangle_[triangle]);
  return pdfOnFace(from, pointOn(face, b), face, face.firstEmitter + EmitterTable::pieceAt(face, b));
}

std::optional<LightSample> LightSampler::sampleSky(Vec2f u) const {
  if (!emitters_.hasSky()) return std::nullopt;
  const Environment::Sample s = emitters_.environment()->sample(static_cast<double>(u.x), static_cast<double>(u.y));
  return LightSample{s.direction, kInfinity, {}, {}, kNone, Rgb(Rgbd(s.radiance) / s.pdf), s.pdf};
}

double LightSampler::pdfSky(Vec3f wi) const { return emitters_.hasSky() ? emitters_.environment()->pdf(wi) : 0; }

Rgb LightSampler::skyRadiance(Vec3f wi) const {
  return emitters_.environment() != nullptr ? emitters_.environment()->radiance(wi) : Rgb{};
}

}  // namespace lucarne
