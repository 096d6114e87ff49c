#include "app/check_lights.h"

#include <algorithm>

#include "base/units.h"

namespace lucarne {
namespace {

struct Source {
  std::string name, kind;
  Rgbd intensity{};  // cd, lx or cd/m²
  Rgbd flux{};       // lm
  double area = 0;   // m², of emissive materials
  std::size_t triangles = 0;
  bool textured = false;
  bool emissive() const { return kind == "emissive"; }
  const char* unit() const {
    return emissive() || kind == "environment" ? "cd/m²" : kind == "directional" ? "lx" : "cd";
  }
};

/// `flux` (mean over channels) in the colour of `light`.
Rgbd coloured(double flux, Rgbd light) {
  const double m = mean(light);
  return m > 0 ? light * (flux / m) : Rgbd{flux};
}

/// Emission of a triangle summed over 16 points of a regular grid: its colour.
Rgbd emissionSum(const PhotonScene& scene, std::uint32_t triangle) {
  constexpr int kCuts = 4;
  Rgbd sum{};
  const auto add = [&](int i, int j, float shift) {
    const Vec2f b{(static_cast<float>(i) + shift) / kCuts, (static_cast<float>(j) + shift) / kCuts};
    sum += Rgbd(scene.surfaces().emission(triangle, b));
  };
  for (int i = 0; i < kCuts; ++i) {
    for (int j = 0; i + j < kCuts; ++j) {
      add(i, j, 1.f / 3);
      if (i + j + 1 < kCuts) add(i, j, 2.f / 3);
    }
  }
  return sum;
}

std::vector<Source> punctualSources(const CheckInput& input, const std::vector<double>& flux) {
  constexpr const char* kinds[] = {"point", "spot", "directional"};
  std::vector<Source> sources;
  for (std::size_t i = 0; i < flux.size(); ++i) {
    const Light& l = input.scene().lights[i];
    Source s;
    s.name = l.name;
    s.kind = kinds[static_cast<int>(l.kind)];
    s.intensity = Rgbd(l.intensity);
    s.flux = coloured(flux[i], s.intensity);
    sources.push_back(s);
  }
  return sources;
}

/// One a material that emits and has triangles.
std::vector<Source> emissiveSources(const CheckInput& input, const std::vector<double>& flux) {
  const Scene& scene = input.scene();
  std::vector<Source> byMaterial(scene.materials.size());
  const double square = scene.frame.scale * scene.frame.scale;
  for (std::uint32_t t = 0; t < flux.size(); ++t) {
    const Material& m = scene.materials[scene.triangles[t].material];
    if (!m.emits()) continue;
    Source& s = byMaterial[scene.triangles[t].material];
    s.area += 0.5 * length(scene.scaledNormal(t)) * square;
    ++s.triangles;
    if (flux[t] > 0)
      s.flux += coloured(flux[t], m.emissiveTexture ? emissionSum(input.photonScene, t) : Rgbd(m.emissive));
  }
  std::vector<Source> sources;
  for (std::size_t i = 0; i < byMaterial.size(); ++i) {
    Source& s = byMaterial[i];
    if (s.triangles == 0) continue;
    s.name = scene.materials[i].name;
    s.kind = "emissive";
    s.intensity = Rgbd(scene.materials[i].emissive);
    s.textured = bool(scene.materials[i].emissiveTexture);
    sources.push_back(s);
  }
  return sources;
}

/// The sky around the scene: its mean radiance, and the flux that comes through the sphere about it.
Source skySource(const Environment& sky, double flux) {
  Source s;
  s.name = sky.name();
  s.kind = "environment";
  s.intensity = sky.meanRadiance();
  s.flux = coloured(flux, s.intensity);
  return s;
}

std::vector<Source> sourcesOf(const CheckInput& input) {
  std::vector<double> byTriangle(input.scene().triangles.size()), byLight(input.scene().lights.size());
  double fromSky = 0;
  const EmitterTable& emitters = input.photonScene.emitters();
  emitters.forEachSource([&](std::uint32_t triangle, std::uint32_t light, double flux) {
    if (triangle != kNone) {
      byTriangle[triangle] += flux;
    } else if (light == EmitterTable::kSky) {
      fromSky = flux;
    } else {
      byLight[light] += flux;
    }
  });
  std::vector<Source> sources = punctualSources(input, byLight);
  for (Source& s : emissiveSources(input, byTriangle)) sources.push_back(std::move(s));
  if (emitters.environment() != nullptr) sources.push_back(skySource(*emitters.environment(), fromSky));
  std::stable_sort(sources.begin(), sources.end(),
                   [](const Source& a, const Source& b) { return luminance(a.flux) > luminance(b.flux); });
  return sources;
}

/// "point light 'a', spot light 'b' and 7 more".
std::string nameSome(const std::vector<Source>& sources) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, sources.size()); ++i) {
    const Source& s = sources[i];
    text += (text.empty() ? "" : ", ") + (s.emissive() ? "emissive material" : s.kind + " light") + " " +
            quotedName(s.name);
  }
  return sources.size() > kMost ? text + " and " + std::to_string(sources.size() - kMost) + " more" : text;
}

template <class Is>
std::vector<Source> those(const std::vector<Source>& sources, const Is& is) {
  std::vector<Source> list;
  std::copy_if(sources.begin(), sources.end(), std::back_inserter(list), is);
  return list;
}

void warnOfDarkness(const std::vector<Source>& sources, double all, CheckWarnings& warnings) {
  if (!(all > 0)) warnings.add("no_light", "no light: the bake will be black; give --environment or add a light");
  const std::vector<Source> dark = those(sources, [](const Source& s) { return !(luminance(s.flux) > 0); });
  if (!dark.empty()) warnings.add("dark_light", "without light: " + nameSome(dark));
}

void warnOfBrightness(const std::vector<Source>& sources, const char* kind, double most, const char* compare,
                      CheckWarnings& warnings) {
  std::vector<Source> bright =
      those(sources, [&](const Source& s) { return s.kind == kind && luminance(s.intensity) > most; });
  if (bright.empty()) return;
  const Source& b = *std::max_element(bright.begin(), bright.end(), [](const Source& x, const Source& y) {
    return luminance(x.intensity) < luminance(y.intensity);
  });
  warnings.add("bright_light", nameSome(bright) + ": up to " + formatNumber(luminance(b.intensity)) + " " + b.unit() +
                                   " (" + compare + "); did the exporter write other units?");
}

/// Light that comes to so little of all is noise.
void warnOfFaintLights(const std::vector<Source>& sources, CheckWarnings& warnings) {
  constexpr double kUnlikelyRatio = 1e6;
  const auto faint = those(sources, [&](const Source& s) {
    return luminance(s.flux) > 0 && luminance(s.flux) * kUnlikelyRatio < luminance(sources.front().flux);
  });
  if (faint.empty()) return;
  warnings.add("faint_light", nameSome(faint) + ": less than a millionth of the light of " + nameSome({sources.front()}) +
                                  "; are they in the same units?");
}

/// Exporters write watts, or numbers without a unit, where glTF wants candela, lux and cd/m².
void warnOfUnits(const std::vector<Source>& sources, double punctual, double emissive, CheckWarnings& warnings) {
  constexpr double kBrightCandela = 1e5, kBrightLux = 2e5, kUnlikelyRatio = 1e4;
  for (const char* kind : {"point", "spot"})
    warnOfBrightness(sources, kind, kBrightCandela, "a bulb of 800 lm has 64 cd", warnings);
  warnOfBrightness(sources, "directional", kBrightLux, "the sun at noon gives about 100000 lx", warnings);
  if (!(punctual > 0 && emissive > 0)) return;
  const double ratio = std::max(punctual / emissive, emissive / punctual);
  if (ratio <= kUnlikelyRatio) return;
  warnings.add("mixed_units",
               std::string(punctual > emissive ? "lights give " : "emissive materials give ") +
                   formatCount(static_cast<std::uint64_t>(std::min(ratio, 1e18))) + " times the light of " +
                   (punctual > emissive ? "emissive materials" : "lights") +
                   ", which will not be seen: is KHR_materials_emissive_strength (cd/m²) missing, or are the lights in "
                   "watts? glTF has candela and lux");
}

nlohmann::json toJson(const Source& s, double all) {
  const auto triple = [](Rgbd v) { return nlohmann::json::array({v.x, v.y, v.z}); };
  const double flux = luminance(s.flux);
  nlohmann::json json = {{"name", s.name},
                         {"kind", s.kind},
                         {"intensity", triple(s.intensity)},
                         {"unit", s.unit()},
                         {"flux_lm", triple(s.flux)},
                         {"luminous_flux_lm", flux},
                         {"share", all > 0 ? flux / all : 0.0}};
  if (s.emissive()) json.update({{"triangles", s.triangles}, {"area_m2", s.area}, {"textured", s.textured}});
  return json;
}

}  // namespace

nlohmann::json checkLights(const CheckInput& input, CheckWarnings& warnings) {
  const std::vector<Source> sources = sourcesOf(input);
  Rgbd punctual{}, emissive{};
  for (const Source& s : sources) (s.emissive() ? emissive : punctual) += s.flux;
  const Rgbd all = punctual + emissive;
  warnOfDarkness(sources, luminance(all), warnings);
  warnOfUnits(sources, luminance(punctual), luminance(emissive), warnings);
  warnOfFaintLights(sources, warnings);
  nlohmann::json list = nlohmann::json::array();
  for (const Source& s : sources) list.push_back(toJson(s, luminance(all)));
  return {{"sources", list},
          {"flux_lm", {all.x, all.y, all.z}},
          {"luminous_flux_lm", luminance(all)},
          {"punctual_luminous_flux_lm", luminance(punctual)},
          {"emissive_luminous_flux_lm", luminance(emissive)}};
}

}  // namespace lucarne
