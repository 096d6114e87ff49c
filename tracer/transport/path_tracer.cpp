#include "tracer/transport/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace lucarne {
namespace {

/// Balance heuristic. A density of 0 says that the other way cannot find the light at all.
float misWeight(double own, double other) { return own > 0 ? static_cast<float>(own / (own + other)) : 1.f; }

float clampedReception(Vec3f wi, Vec3f n, Vec3f ns) {
  return ns == n ? 1.f : std::min(shadingReception(wi, n, ns), kLargestShadingCorrection);
}

/// What a shadow ray goes through that takes a part of its light. Each triangle counts once, however often it is asked
/// about, and in the order of their numbers.
class Veils {
 public:
  bool goThrough(std::uint32_t triangle, float coverage) {
    if (coverage > 0 && coverage < 1) open_.emplace_back(triangle, 1 - coverage);
    return coverage < 1;
  }
  float open() {
    std::sort(open_.begin(), open_.end());
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    open_.erase(std::unique(open_.begin(), open_.end(), same), open_.end());
    float product = 1;
    for (const auto& veil : open_) product *= veil.second;
    return product;
  }

 private:
  std::vector<std::pair<std::uint32_t, float>> open_;  // by triangle
};

}  // namespace

Receiver receiverAt(const PhotonScene& scene, std::uint32_t triangle, Vec2f b, bool back) {
  const Scene& s = scene.scene();
  const Vec3d p0(s.corner(triangle, 0)), e1 = Vec3d(s.corner(triangle, 1)) - p0, e2 = Vec3d(s.corner(triangle, 2)) - p0;
  const Vec3f n(normalize(s.scaledNormal(triangle)));
  const bool smooth = !s.smooth.empty() && s.smooth[triangle] != 0;
  const Hit hit{triangle,
                b,
                p0 + e1 * static_cast<double>(b.x) + e2 * static_cast<double>(b.y),
                n,
                back,
                smooth,
                s.triangles[triangle].material,
                scene.rayCaster().clearance(triangle)};
  const Vec3f side = back ? -n : n;
  return {hit, side, scene.shadingNormal(hit, side)};
}

/// A place where a path scatters. wo looks back along the path; normals are those of its side.
struct PathTracer::Vertex {
  Hit hit;
  Vec3f wo, n, ns;
  Frame<float> frame;
  Vec3f woLocal;
  Scattering scattering;
  std::uint32_t medium;  // before the surface, on the side of wo

  Vertex(const PhotonScene& scene, const Hit& h, Vec3f wo_, std::uint32_t medium_)
      : hit(h),
        wo(wo_),
        n(h.back ? -h.n : h.n),
        ns(scene.mappedNormal(h, n, scene.shadingNormal(h, n))),
        frame(ns),
        woLocal(frame.toLocal(wo)),
        scattering(scatteringAt(scene.surfaces(), placeOf(h), h.back)),
        medium(medium_) {}

  /// What the photon that goes the other way is weighted with over what is right: its clamp, and 0 where light would
  /// leak (shading_normal.h).
  float clampOfPhotons(Vec3f wi) const {
    if (ns == n) return 1;
    const bool before = dot(wi, n) > 0;
    const float c = adjointCorrection(wi, wo, before ? n : -n, before ? ns : -ns);
    return c > 0 ? std::min(1.f, kLargestShadingCorrection / c) : 0.f;
  }
  std::uint32_t mediumToward(const SurfaceTable& surfaces, Vec3f wi) const {
    if (dot(wi, n) > 0 || !surfaces.solid(hit.material)) return medium;
    return hit.back ? kNone : hit.material;
  }
  RayStart start(Vec3f wi) const {
    return {RayCaster::leave(hit.position, dot(wi, n) > 0 ? n : -n, hit.clearance), wi, hit.triangle};
  }
};

PathTracer::PathTracer(const PhotonScene& scene, const PathLimits& limits)
    : scene_(scene),
      lights_(scene.scene(), scene.emitters(), scene.surfaces()),
      limits_(limits),
      raysFindLight_(scene.emitters().hasSky() || scene.emitters().faceCount() > 0) {}

Rgb PathTracer::transmittance(std::uint32_t medium, double localDistance) const {
  if (medium == kNone || scene_.surfaces().attenuation(medium).clear()) return Rgb(1.f);
  return scene_.surfaces().attenuation(medium).over(localDistance * scene_.scene().frame.scale);
}

Rgb PathTracer::visibility(const RayStart& ray, const LightSample& light, std::uint32_t medium) const {
  const bool finite = std::isfinite(light.distance);
  const double distance = finite ? length(light.target - Vec3d(ray.origin)) : light.distance;
  // What is between: in front of the lamp's plane. The way along the ray would not tell: it starts a little off its
  // surface, beside the ray to the target, and at grazing angles meets the lamp's plane much sooner.
  const double touching =
      light.triangle == kNone ? 0 : 2 * static_cast<double>(scene_.rayCaster().clearance(light.triangle));
  const auto within = [&](const Hit& hit) {
    if (light.triangle != kNone) return dot(hit.position - light.target, Vec3d(light.normal)) > touching;
    return length(hit.position - Vec3d(ray.origin)) < distance * (1 - 0x1p-20) - 0x1p-20;
  };
  Veils veils;
  std::uint64_t repeats = 0;
  Hit hit;
  const bool met = meetSurface<true>(
      scene_, ray, repeats, [](std::uint32_t) {},
      [&](const Hit& h) {
        return within(h) && veils.goThrough(h.triangle, scene_.surfaces().coverage(placeOf(h), h.back));
      },
      hit);
  if (met && within(hit)) return {};
  return transmittance(medium, finite ? distance : 0) * veils.open();
}

std::optional<LightSample> PathTracer::sampleLight(Source source, Vec3d from, std::uint32_t event,
                                                   const PhotonSampler& sampler) const {
  if (source == Source::sky) {
    const auto u = sampler.floats(event, Stream::sky);
    return lights_.sampleSky({u[0], u[1]});
  }
  const auto w = sampler.words(event, Stream::lamp);
  return lights_.sampleLocal(from, {toUnitDouble(w[0], w[1]), {toUnitFloat(w[2]), toUnitFloat(w[3])}});
}

Rgb PathTracer::lightAt(const Vertex& v, Source source, std::uint32_t event, const PhotonSampler& sampler) const {
  const std::optional<LightSample> light = sampleLight(source, v.hit.position, event, sampler);
  if (!light) return {};
  const Vec3f wiLocal = v.frame.toLocal(light->wi);
  const Rgb f = evaluate(v.scattering, v.woLocal, wiLocal, Transport::radiance);
  const float factor = std::abs(wiLocal.z) * v.clampOfPhotons(light->wi);
  if (!(maxComponent(f) * factor > 0)) return {};
  const auto bsdfPdf = static_cast<double>(pdf(v.scattering, v.woLocal, wiLocal));
  const Rgb visible = visibility(v.start(light->wi), *light, v.mediumToward(scene_.surfaces(), light->wi));
  return f * light->weight * visible * (factor * misWeight(light->pdf, bsdfPdf));
}

Rgb PathTracer::emitted(const Hit& hit, const Walk& walk) const {
  const Material& m = scene_.scene().materials[hit.material];
  if (!m.emits() || (hit.back && !m.doubleSided)) return {};
  const Rgb radiance = scene_.surfaces().emittedRadiance(placeOf(hit));
  return radiance * misWeight(walk.pdf, lights_.pdfLocal(walk.from, hit.triangle, hit.b));
}

Rgb PathTracer::sky(const Walk& walk) const {
  return lights_.skyRadiance(walk.ray.direction) * misWeight(walk.pdf, lights_.pdfSky(walk.ray.direction));
}

bool PathTracer::walkOn(Walk& walk, const Vertex& v, std::uint32_t event, const PhotonSampler& sampler) const {
  const auto u = sampler.floats(event, Stream::scatter);
  const auto s = sample(v.scattering, v.woLocal, {u[0], u[1], u[2]}, Transport::radiance);
  if (!s) return false;
  const Vec3f wi = normalize(v.frame.toWorld(s->wo));
  walk.throughput = walk.throughput * s->weight * v.clampOfPhotons(wi);
  constexpr std::uint32_t kSureEvents = 3;
  const float survival = event < kSureEvents ? 1.f : std::min(1.f, maxComponent(walk.throughput));
  if (!(u[3] < survival)) return false;
  walk.throughput *= 1 / survival;
  walk.pdf = static_cast<double>(s->pdf);
  walk.medium = v.mediumToward(scene_.surfaces(), wi);
  walk.ray = v.start(wi);
  walk.from = v.hit.position;
  return true;
}

std::optional<Hit> PathTracer::advance(Walk& walk, std::uint32_t event, const PhotonSampler& sampler,
                                       Rgb& seen) const {
  std::uint64_t repeats = 0;
  Hit hit;
  const bool met = meetSurface<true>(
      scene_, walk.ray, repeats, [](std::uint32_t) {},
      [&](const Hit& h) { return goesThroughByChance(scene_.surfaces(), h, sampler, event); },
      hit);
  if (!met) {
    seen += walk.throughput * sky(walk);
    return std::nullopt;
  }
  const bool inside = hit.back && scene_.surfaces().solid(hit.material);
  if (inside) walk.medium = hit.material;
  walk.throughput = walk.throughput * transmittance(walk.medium, length(hit.position - Vec3d(walk.ray.origin)));
  seen += walk.throughput * emitted(hit, walk);
  return hit;
}

PathTracer::Found PathTracer::follow(Walk walk, const PhotonSampler& sampler) const {
  Found found;
  for (std::uint32_t event = 1;; ++event) {
    const std::optional<Hit> hit = advance(walk, event, sampler, event == 1 ? found.direct : found.indirect);
    if (!hit || isBlackBack(scene_, *hit) || event > limits_.depth) return found;
    const Vertex vertex(scene_, *hit, -walk.ray.direction, walk.medium);
    if (!(vertex.woLocal.z > 0)) return found;
    found.indirect += walk.throughput *
                      (lightAt(vertex, Source::lamps, event, sampler) + lightAt(vertex, Source::sky, event, sampler));
    if (!walkOn(walk, vertex, event, sampler)) return found;
  }
}

Rgb PathTracer::radiance(const RayStart& ray, const PhotonSampler& sampler) const {
  Walk walk;
  walk.ray = ray;
  const Found found = follow(walk, sampler);
  return found.direct + found.indirect;
}

void PathTracer::receiveLights(const Receiver& at, const PhotonSampler& sampler, ReceivedLight& received) const {
  const Vec3f origin = RayCaster::leave(at.hit.position, at.n, at.hit.clearance);
  for (const Source source : {Source::lamps, Source::sky}) {
    const auto light = sampleLight(source, at.hit.position, 0, sampler);
    if (!light) continue;
    const float cosine = dot(light->wi, at.n);
    const float factor = cosine * clampedReception(light->wi, at.n, at.ns);
    if (!(cosine > 0 && factor > 0)) continue;
    const float weight = misWeight(light->pdf, static_cast<double>(cosine / kPi));
    const Rgb visible = visibility({origin, light->wi, at.hit.triangle}, *light, kNone);
    received.add(light->wi, light->weight * visible * (factor * weight), true);
  }
}

/// In a direction with the density of the cosine, or without throughput where the interpolated normal takes no light.
PathTracer::Walk PathTracer::walkFrom(const Receiver& at, const PhotonSampler& sampler) const {
  const auto u = sampler.floats(0, Stream::scatter);
  const Vec3f wiLocal = sampleCosineHemisphere({u[1], u[2]});
  const Vec3f wi = normalize(Frame<float>(at.n).toWorld(wiLocal));
  Walk walk;
  walk.ray = {RayCaster::leave(at.hit.position, at.n, at.hit.clearance), wi, at.hit.triangle};
  walk.from = at.hit.position;
  walk.throughput = Rgb(kPi * clampedReception(wi, at.n, at.ns));
  walk.pdf = static_cast<double>(wiLocal.z / kPi);
  return walk;
}

ReceivedLight PathTracer::receive(const Receiver& at, const PhotonSampler& sampler) const {
  ReceivedLight received;
  receiveLights(at, sampler, received);
  const Walk walk = walkFrom(at, sampler);
  if (!(maxComponent(walk.throughput) > 0)) return received;
  const Found found = follow(walk, sampler);
  received.add(walk.ray.direction, found.direct, true);
  received.add(walk.ray.direction, found.indirect, false);
  return received;
}

ReceivedLight PathTracer::receiveDirect(const Receiver& at, const PhotonSampler& sampler) const {
  ReceivedLight received;
  receiveLights(at, sampler, received);
  if (!raysFindLight_) return received;
  Walk walk = walkFrom(at, sampler);
  if (!(maxComponent(walk.throughput) > 0)) return received;
  Rgb seen{};
  advance(walk, 1, sampler, seen);
  received.add(walk.ray.direction, seen, true);
  return received;
}

}  // namespace lucarne
