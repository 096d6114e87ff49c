// The text of a check, made from its JSON, so that both say the same.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/check.h"
#include "app/check_input.h"
#include "base/units.h"

namespace lucarne {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kIndent = 12, kWidth = 110;

/// Sections "title       first line" with the following lines under the first.
class Sections {
 public:
  void begin(const std::string& title) { title_ = title; }
  /// Breaks at spaces; what follows a break is indented by `hang` more.
  void line(const std::string& text, std::size_t hang = 0) {
    std::string rest = text;
    std::size_t indent = 0;
    while (indent + rest.size() > kWidth - kIndent) {
      const std::size_t at = rest.rfind(' ', kWidth - kIndent - indent);
      if (at == std::string::npos || at == 0) break;
      put(std::string(indent, ' ') + rest.substr(0, at));
      rest = rest.substr(at + 1);
      indent = hang;
    }
    put(std::string(indent, ' ') + rest);
  }
  const std::string& text() const { return text_; }

 private:
  void put(const std::string& s) {
    text_ += title_ + std::string(kIndent - title_.size(), ' ') + s + "\n";
    title_.clear();
  }
  std::string title_, text_;
};

std::string counted(const Json& count, const std::string& what) {
  const auto n = count.get<std::uint64_t>();
  return formatCount(n) + " " + what + (n == 1 ? "" : "s");
}

std::string number(const Json& value) { return formatNumber(value.get<double>()); }

/// "535", "59.1k": three digits of what is large.
std::string amount(double value) {
  constexpr double kMost = 1e18;
  if (value < 9999.5 || value > kMost) return formatNumber(value);
  return formatCount(static_cast<std::uint64_t>(value + 0.5));
}

/// Of millimetres.
std::string lengthOf(double mm) { return mm < 1000 ? formatNumber(mm) + " mm" : formatNumber(mm / 1000) + " m"; }

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

void writeScene(const Json& scene, Sections& out) {
  out.begin("scene");
  const Json& e = scene["extent_m"];
  out.line(scene["name"].get<std::string>() + ": " + counted(scene["triangles"], "triangle") + ", " +
           counted(scene["materials"], "material") + ", " + number(e[0]) + " x " + number(e[1]) + " x " + number(e[2]) +
           " m");
  if (scene["degenerate_triangles"] > 0) out.line(counted(scene["degenerate_triangles"], "triangle") + " without area");
}

void writeFeatures(const Json& checked, Sections& out) {
  out.begin("modelled");
  for (const char* of : {"triangles", "lights", "materials"}) {
    std::string text;
    for (const Json& f : checked["modelled"])
      if (f["of"] == of)
        text += (text.empty() ? "" : ", ") + f["feature"].get<std::string>() + " " +
                formatCount(f["count"].get<std::uint64_t>());
    if (!text.empty()) out.line(std::string(of) + ": " + text, 2);
  }
  if (checked["modelled"].empty()) out.line("plain opaque surfaces");
  out.begin("left out");
  for (const Json& what : checked["left_out"]) out.line(what.get<std::string>(), 2);
  if (checked["left_out"].empty()) out.line("nothing");
}

std::string describe(const Json& source) {
  const Json& i = source["intensity"];
  const double value = luminance(Rgbd{i[0].get<double>(), i[1].get<double>(), i[2].get<double>()});
  std::ostringstream text;
  text << source["kind"].get<std::string>() << ' ' << quotedName(source["name"].get<std::string>()) << ", ";
  const bool emissive = source["kind"] == "emissive";
  if (emissive && source["textured"].get<bool>()) text << "at most ";
  text << amount(value) << ' ' << source["unit"].get<std::string>();
  if (emissive) text << " over " << number(source["area_m2"]) << " m²";
  return text.str();
}

void writeLights(const Json& lights, Sections& out) {
  out.begin("lights");
  const Json& sources = lights["sources"];
  if (sources.empty()) return out.line("none");
  out.line(amount(lights["luminous_flux_lm"].get<double>()) + " lm of " + counted(sources.size(), "source"));
  constexpr std::size_t kMost = 12;
  double rest = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto flux = sources[i]["luminous_flux_lm"].get<double>();
    if (i >= kMost) {
      rest += flux;
      continue;
    }
    out.line(padded(amount(flux), 8) + " lm " + padded(formatPercent(sources[i]["share"].get<double>()), 7) + "  " +
                 describe(sources[i]),
             21);
  }
  if (sources.size() > kMost)
    out.line(padded(amount(rest), 8) + " lm of " + std::to_string(sources.size() - kMost) + " weaker ones");
}

void writeUv(const Json& uv, const Json& layout, Sections& out) {
  out.begin("uv");
  if (!uv["present"].get<bool>()) return out.line("no TEXCOORD_1; not needed, the bake makes charts of its own");
  const auto area = uv["area"].get<double>();
  std::string text = "TEXCOORD_1 " + std::string(uv["inside_unit_square"].get<bool>() ? "inside" : "leaves") +
                     " the unit square, area " + number(uv["area"]) + (area > 1 ? " (overlaps)" : "");
  if (uv["triangles_without_area"] > 0) text += ", " + counted(uv["triangles_without_area"], "triangle") + " without area";
  out.line(text + "; " + formatCount(layout["uv1_charts"].get<std::uint64_t>()) + " of " +
               counted(layout["charts"], "chart") + " are of it, the others are grown",
           2);
}

void writeSurfaces(const Json& s, Sections& out) {
  constexpr std::size_t kMost = 4;
  out.begin("surfaces");
  out.line(counted(s["meshes"], "mesh piece") + ": " + formatCount(s["closed"].get<std::uint64_t>()) + " closed, " +
               formatCount(s["open"].get<std::uint64_t>()) + " open, of these " +
               formatCount(s["one_sided_open"].get<std::uint64_t>()) + " one-sided (black and without maps from behind)" +
               (s["crowded_edges"] > 0 ? "; " + counted(s["crowded_edges"], "edge") + " with more than two triangles" : ""),
           2);
  for (std::size_t i = 0; i < std::min(kMost, s["list"].size()); ++i) {
    const Json& mesh = s["list"][i];
    out.line("open: " + quotedName(mesh["name"].get<std::string>()) + " of " +
                 quotedName(mesh["material"].get<std::string>()) + ", " + counted(mesh["open_edges"], "edge") +
                 (mesh["one_sided"].get<bool>() ? ", one-sided" : ""),
             6);
  }
  if (s["list"].size() > kMost) out.line("and more; --json lists 20");
}

void writeLayout(const Json& layout, Sections& out) {
  out.begin("layout");
  std::string text = counted(layout["charts"], "chart") + ", " + counted(layout["texels"], "texel") + " on " +
                     counted(layout["chart_sides"], "side") + " at " + number(layout["texels_per_metre_used"]) +
                     " texels/m";
  if (layout["thinned"].get<bool>()) text += " (" + number(layout["texels_per_metre"]) + " asked for)";
  text += ", " + lengthOf(layout["mean_texel_mm"].get<double>()) + " a texel on average";
  out.line(text, 2);
  out.line("texels per metre of charts: " + number(layout["texels_per_metre_min"]) + " to " +
           number(layout["texels_per_metre_max"]) + ", median by surface " + number(layout["texels_per_metre_median"]));
  if (const Json& largest = layout["largest_chart"]; !largest.is_null())
    out.line("largest chart " + largest["width"].dump() + " x " + largest["height"].dump() + " texels, of " +
             quotedName(largest["material"].get<std::string>()));
  const auto sides = layout["chart_sides"].get<std::uint64_t>(),
             glossy = layout["sides_with_directions"].get<std::uint64_t>();
  out.line(counted(glossy, "side") + " with maps by direction (" + counted(layout["directions"], "direction") + "), " +
           formatCount(sides - glossy) + " with irradiance alone");
}

void writeResources(const Json& r, Sections& out) {
  const auto bytes = [&r](const char* key) { return formatBytes(r[key].get<std::uint64_t>()); };
  out.begin("memory");
  out.line("about " + bytes("expected_peak_memory_bytes") + ", of it " + bytes("tally_bytes") + " of tallies; " +
           bytes("free_memory_bytes") + " are free");
  out.begin("disk");
  out.line("light maps up to " + bytes("dlm_bytes") + ", saved states up to " + bytes("checkpoint_bytes") + "; " +
           bytes("free_disk_bytes") + " are free here");
}

void writeTime(const Json& time, Sections& out) {
  out.begin("time");
  const auto photons = time["photons"].get<std::uint64_t>();
  if (!time.contains("seconds")) return out.line("nothing to trace");
  out.line("about " + formatDuration(time["seconds"].get<double>()) + " for " + counted(photons, "photon") + " on " +
               counted(time["threads"], "thread") + ": " +
               formatRate(time["photons_per_second"].get<double>(), "photons") +
               (time["sampled_tally_bytes"] > 0 ? "" : " (storing nothing)") + ", " + number(time["rays_per_photon"]) +
               " rays a photon",
           2);
  out.line("tracing loop: " + time["variant"]["name"].get<std::string>());
  out.line("reading and layout before it took " + formatDuration(time["seconds_of_setup"].get<double>()));
  out.line(amount(time["photons_per_texel"].get<double>()) + " photons fall into a texel, on average");
  out.line("of the light " + formatPercent(time["missed"].get<double>()) + " meets no surface, " +
           formatPercent(time["lost"].get<double>()) + " ends on black backs; " +
           formatPercent(time["escaped"].get<double>()) + " leaves the scene in the end");
}

}  // namespace

std::string checkText(const nlohmann::json& checked) {
  Sections out;
  writeScene(checked["scene"], out);
  writeFeatures(checked, out);
  writeLights(checked["lights"], out);
  writeUv(checked["uv"], checked["layout"], out);
  writeSurfaces(checked["surfaces"], out);
  writeLayout(checked["layout"], out);
  writeResources(checked["resources"], out);
  writeTime(checked["time"], out);
  out.begin("warnings");
  for (const Json& w : checked["warnings"]) out.line("- " + w["text"].get<std::string>(), 2);
  if (checked["warnings"].empty()) out.line("none");
  if (checked["failures"].empty()) return out.text();
  out.begin("would fail");
  for (const Json& why : checked["failures"]) out.line("- " + why.get<std::string>(), 2);
  return out.text();
}

}  // namespace lucarne
