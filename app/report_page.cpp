#include "app/report_page.h"

#include <algorithm>
#include <cmath>

#include "app/check_input.h"
#include "app/page_writer.h"
#include "app/rate_picture.h"
#include "base/units.h"

namespace lucarne {
namespace {

using Json = nlohmann::json;
using Row = PageWriter::Row;

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    // Should a text ever come through as markup, it still could neither run nor fetch anything.
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
    "'unsafe-inline'\">\n"
    "<style>\n"
    ":root{color-scheme:light dark;--ink:#1c2026;--paper:#fdfcf9;--faint:#6a717c;--line:#d9d6cd;--mark:#b4530a}\n"
    "@media(prefers-color-scheme:dark){:root{--ink:#e4e4e2;--paper:#191b20;--faint:#9aa1ad;--line:#363a43;"
    "--mark:#f0a35e}}\n"
    "body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:60rem;margin:0 auto;"
    "padding:1rem;overflow-wrap:anywhere}\n"
    "h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0}h2{font-size:1.15rem;margin:2rem 0 .5rem;border-bottom:1px "
    "solid var(--line)}\n"
    "p{margin:.5rem 0}.note,figcaption{color:var(--faint);font-size:.9rem}\n"
    ".wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;overflow-wrap:normal}\n"
    "th,td{padding:.2rem .7rem .2rem 0;border-bottom:1px solid var(--line);vertical-align:top;text-align:left;"
    "font-weight:normal}\n"
    "table.numbers td,table.numbers th:not(:first-child){text-align:right}tr:first-child th{color:var(--faint)}\n"
    "table.numbers th[scope]{color:inherit}table.words th[scope]{color:var(--faint)}\n"
    "pre{white-space:pre-wrap;border:1px solid var(--line);padding:.6rem;font-size:.9rem;user-select:all}\n"
    ".pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,20rem),1fr));gap:1rem}\n"
    "figure{margin:0}img{width:100%;height:auto;display:block;background:#22252e}\n"
    "ul{padding-left:1.2rem}ul.warnings li::marker{content:\"! \";color:var(--mark);font-weight:bold}\n"
    ".dots img{image-rendering:pixelated}\n"
    "svg{width:100%;height:auto}svg text{fill:var(--faint);font-size:12px}.rate{fill:none;stroke:var(--mark);"
    "stroke-width:1.5}\n"
    ".under{fill:var(--mark);opacity:.12}.axis{fill:none;stroke:var(--faint)}.faint{opacity:.4}\n"
    "</style>\n";

/// A member, or null.
const Json& at(const Json& object, const char* key) {
  static const Json kNothing;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : kNothing;
}

double number(const Json& value) { return value.is_number() ? value.get<double>() : 0; }

std::uint64_t count(const Json& value) {
  return value.is_number_unsigned() ? value.get<std::uint64_t>()
                                    : static_cast<std::uint64_t>(std::clamp(number(value), 0., 1e18));
}

std::string text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return formatNumber(value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.is_null() ? "" : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// "1.23M", "23.4", "0.00123".
std::string amount(double value) {
  return std::abs(value) < 9999.5 || std::abs(value) > 1e18 || value < 0
             ? formatNumber(value)
             : formatCount(static_cast<std::uint64_t>(value + 0.5));
}

double meanOf(const Json& rgb) {
  if (!rgb.is_array() || rgb.size() != 3) return 0;
  return (number(rgb[0]) + number(rgb[1]) + number(rgb[2])) / 3;
}

std::vector<std::string> texts(const Json& list) {
  std::vector<std::string> result;
  for (const Json& item : list) result.push_back(text(item.is_object() ? at(item, "text") : item));
  return result;
}

void writeTop(const Json& r, PageWriter& page) {
  page.raw("<title>" + escapeHtml("Lucarne: " + text(at(r, "scene"))) + "</title></head>\n<body><h1>" +
           escapeHtml(text(at(r, "scene"))) + "</h1>\n");
  std::string line = formatCount(count(at(r, "photons"))) + " photons in " + formatDuration(number(at(r, "seconds"))) +
                     " of tracing, " + formatRate(number(at(r, "photons_per_second")), "photons");
  if (at(r, "parts").is_number()) line += ", merged of " + formatCount(count(at(r, "parts"))) + " parts";
  page.paragraph(line + ".");
  if (const Json& error = at(r, "estimated_relative_error"); error.is_number())
    page.paragraph("Estimated error of the light maps: " + formatPercent(error.get<double>()) +
                   " of the irradiance (one standard error, weighted by light).");
  if (const Json& missing = at(r, "missing_photons"); missing.is_array() && !missing.empty())
    page.paragraph("Photons are missing, so there is more noise than planned: " + text(missing));
}

void writeWarnings(const Json& r, PageWriter& page) {
  page.heading("Warnings");
  const std::vector<std::string> warnings = texts(at(r, "warnings"));
  warnings.empty() ? page.paragraph("None.") : page.list(warnings, "warnings");
}

void writePictures(const std::vector<PagePicture>& pictures, const char* kind, PageWriter& page) {
  if (pictures.empty()) return;
  page.raw(std::string("<div class=\"") + kind + "\">");
  for (const PagePicture& p : pictures) page.picture(p.title, p.how, p.width, p.height, p.png);
  page.raw("</div>\n");
}

void writeAllPictures(const ReportPictures& pictures, PageWriter& page) {
  page.heading("What the cameras see");
  writePictures(pictures.cameras, "pictures", page);
  for (const std::string& note : pictures.notes) page.note(note);
  if (pictures.maps.empty()) return;
  page.heading("Where the light maps are noisy");
  writePictures(pictures.maps, "pictures dots", page);
}

struct LedgerTerm {
  const char *key, *name;
};
constexpr LedgerTerm kTerms[] = {{"absorbed", "absorbed by surfaces"},      {"escaped", "escaped from the scene"},
                                 {"cut_off", "cut off after 1024 bounces"}, {"roulette", "roulette, net"},
                                 {"shading_normal", "shading normals"},     {"emitted", "emitted = sum of the above"}};

void writeLedger(const Json& r, PageWriter& page) {
  const Json& flux = at(r, "flux_lm");
  page.heading("Where the light went");
  const double emitted = meanOf(at(flux, "emitted"));
  std::vector<Row> rows;
  for (const LedgerTerm& term : kTerms) {
    const Json& rgb = at(flux, term.key);
    Row row = {term.name};
    for (std::size_t c = 0; c < 3; ++c) row.push_back(rgb.is_array() && rgb.size() == 3 ? amount(number(rgb[c])) : "");
    row.push_back(emitted > 0 ? formatPercent(meanOf(rgb) / emitted) : "");
    rows.push_back(std::move(row));
  }
  page.table({"lumens", "red", "green", "blue", "share"}, rows);
  page.paragraph(at(r, "ledger_balances") == true ? "The terms add up exactly, to the last unit of the fixed point."
                                                  : "The terms do not add up: this is an error of the program.");
  const double off = meanOf(at(flux, "absorbed")) - meanOf(at(r, "expected_absorbed_lm"));
  const double standardError = number(at(r, "absorbed_standard_error_lm")) / 3;
  if (standardError > 0)
    page.note("Absorbed light differs from what the albedos lead to expect by " + formatNumber(off / standardError) +
              " standard errors. Incident light, every bounce counted: " + amount(meanOf(at(r, "incident_lm"))) +
              " lm (mean over the channels).");
}

void writeLights(const Json& r, PageWriter& page) {
  constexpr std::size_t kMost = 40;
  const Json& lights = at(r, "lights");
  page.heading("Lights");
  if (!lights.is_array()) return page.paragraph("Not known: the sky of the bake was not at hand.");
  if (lights.empty()) return page.paragraph("There are none.");
  std::vector<Row> rows;
  for (const Json& light : lights) {
    if (rows.size() == kMost) break;
    const Json& i = at(light, "intensity");
    const bool known = i.is_array() && i.size() == 3;
    const Rgbd intensity = known ? Rgbd{number(i[0]), number(i[1]), number(i[2])} : Rgbd{};
    rows.push_back({quotedName(text(at(light, "name"))), text(at(light, "kind")),
                    amount(luminance(intensity)) + " " + text(at(light, "unit")),
                    amount(number(at(light, "luminous_flux_lm"))), formatPercent(number(at(light, "share")))});
  }
  page.table({"", "kind", "strength", "lumens", "share"}, rows);
  if (lights.size() > kMost) page.note("and " + std::to_string(lights.size() - kMost) + " weaker ones");
}

void writeRates(const Json& r, PageWriter& page) {
  page.heading("Speed");
  const Json& curve = at(r, "rate_curve");
  const std::string picture = curve.is_object() ? ratePicture(curve) : std::string();
  picture.empty() ? page.paragraph("No curve: too short, or merged of parts that have no clock in common.")
                  : page.raw(picture + "\n");
  page.note(formatCount(count(at(r, "rays"))) + " rays, " + formatRate(number(at(r, "rays_per_second")), "rays") +
            "; tracing loop: " + text(at(at(r, "trace_variant"), "name")) +
            "; states saved in the last run: " + text(at(r, "checkpoints")) + ".");
}

void writeLeftOut(const Json& r, PageWriter& page) {
  page.heading("Left out");
  std::vector<std::string> items = texts(at(r, "left_out"));
  for (const Json& why : at(r, "uv1_refused")) items.push_back(text(why) + ": charts were grown instead");
  for (const Json& w : at(r, "widened_highlights"))
    items.push_back("highlights of material " + quotedName(text(at(w, "material"))) +
                    " are shown wider than they are: more --directions help");
  items.empty() ? page.paragraph("Nothing.") : page.list(items);
}

void writeSize(const Json& r, PageWriter& page) {
  page.heading("Light maps");
  std::vector<Row> rows;
  for (const char* key : {"charts", "uv1_charts", "texels", "directions", "stored_hits"})
    if (at(r, key).is_number()) rows.push_back({key, formatCount(count(at(r, key)))});
  for (const char* key : {"tally_bytes", "map_bytes", "peak_memory_bytes"})
    if (at(r, key).is_number()) rows.push_back({key, formatBytes(count(at(r, key)))});
  if (const Json& seams = at(r, "seams"); seams.is_object())
    rows.push_back({"seams", formatCount(count(at(seams, "count"))) + ", jump " +
                                 formatPercent(number(at(seams, "rms_jump"))) + " (" + text(at(seams, "mode")) + ")"});
  page.table({}, rows, false);
}

/// Members of an object, one a row.
void writeMembers(const Json& object, PageWriter& page) {
  std::vector<Row> rows;
  for (const auto& [key, value] : object.items()) rows.push_back({key, text(value)});
  page.table({}, rows, false);
}

void writeMakers(const Json& r, PageWriter& page) {
  page.heading("Made by");
  std::vector<Row> rows = {{"program", text(at(r, "program"))}};
  for (const Json& build : at(r, "builds")) rows.push_back({"build", text(build)});
  rows.push_back({"ray caster", text(at(r, "ray_caster"))});
  const Json& host = at(r, "host");
  rows.push_back({"machine", text(at(host, "cpu")) + ", " + text(at(host, "threads")) + " threads, " +
                                 formatBytes(count(at(host, "memory_bytes"))) + ", " + text(at(host, "system"))});
  rows.push_back({"used", text(at(r, "threads")) + " threads of each of " + text(at(r, "ranks")) + " processes"});
  for (const char* key : {"content_hash", "scene_hash", "scene_file_hash", "settings_hash"})
    rows.push_back({key, text(at(r, key))});
  page.table({}, rows, false);
}

}  // namespace

std::string reportPage(const nlohmann::json& report, const ReportPictures& pictures) {
  PageWriter page;
  page.raw(kHead);
  writeTop(report, page);
  writeWarnings(report, page);
  writeAllPictures(pictures, page);
  writeLedger(report, page);
  writeLights(report, page);
  writeRates(report, page);
  writeLeftOut(report, page);
  writeSize(report, page);
  page.heading("Settings");
  writeMembers(at(report, "settings"), page);
  writeMakers(report, page);
  page.heading("The same again");
  page.code(text(at(report, "command")));
  page.raw("</body></html>\n");
  return page.html();
}

}  // namespace lucarne
