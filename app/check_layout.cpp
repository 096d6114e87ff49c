#include "app/check_layout.h"

#include <algorithm>

#include "app/bake_scene.h"
#include "base/memory.h"
#include "base/units.h"
#include "dlm/mean_direction.h"

namespace lucarne {
namespace {

/// Texels that hold no surface get no light of their own.
std::uint64_t coveredTexels(const BakePlan& plan) {
  std::uint64_t covered = 0;
  for (const TallySide& side : plan.tallies.sides) {
    const std::uint64_t first = plan.layout.charts[side.chart].firstTexel;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) covered += plan.layout.area[first + t] > 0 ? 1 : 0;
  }
  return covered;
}

/// Metres; of the square that is as large as the mean texel.
double meanTexel(const Scene& scene, const BakePlan& plan) {
  double area = 0;
  for (const Chart& c : plan.charts.charts) area += c.size.x * c.size.y;
  const auto texels = static_cast<double>(plan.layout.texelCount);
  return texels > 0 ? scene.frame.scale * std::sqrt(area / texels) : 0;
}

/// Texels a metre of charts, and the surface they have; ascending. Charts smaller than a texel get a whole one all the
/// same, which says nothing of density: those less than two texels wide or high do not count.
std::vector<std::pair<double, double>> densities(const Scene& scene, const BakePlan& plan) {
  std::vector<std::pair<double, double>> list;
  for (std::size_t i = 0; i < plan.charts.charts.size(); ++i) {
    if (plan.layout.charts[i].width < 2 || plan.layout.charts[i].height < 2) continue;
    const Vec2d d = plan.layout.charts[i].texelsPerLocal;
    list.emplace_back(std::sqrt(d.x * d.y) / scene.frame.scale, plan.charts.charts[i].area);
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Half of the surface has no more texels a metre than this.
double medianDensity(const std::vector<std::pair<double, double>>& ascending) {
  double all = 0, sum = 0;
  for (const auto& [density, area] : ascending) all += area;
  for (const auto& [density, area] : ascending)
    if ((sum += area) >= all / 2) return density;
  return 0;
}

nlohmann::json largestChart(const Scene& scene, const BakePlan& plan) {
  const auto& charts = plan.layout.charts;
  const auto at = std::max_element(charts.begin(), charts.end(), [](const ChartLayout& a, const ChartLayout& b) {
    return a.texelCount() < b.texelCount();
  });
  if (at == charts.end()) return nullptr;
  const Chart& chart = plan.charts.charts[static_cast<std::size_t>(at - charts.begin())];
  return {{"width", at->width}, {"height", at->height}, {"material", scene.materials[chart.material].name}};
}

struct TinyCharts {
  std::size_t count = 0;
  double areaShare = 0;  // of all surface
};

/// Charts with less surface than a tenth of the texel that the density asks for.
TinyCharts tinyCharts(const Scene& scene, const BakePlan& plan) {
  const double texel = 1 / (plan.layout.texelsPerMetre * scene.frame.scale);
  TinyCharts tiny;
  double all = 0;
  for (const Chart& c : plan.charts.charts) {
    all += c.area;
    if (c.area >= 0.1 * texel * texel) continue;
    ++tiny.count;
    tiny.areaShare += c.area;
  }
  tiny.areaShare /= all > 0 ? all : 1;
  return tiny;
}

void warnOfLayout(const CheckInput& in, const TinyCharts& tiny, CheckWarnings& warnings) {
  const TexelLayout& layout = in.plan.layout;
  if (layout.thinned)
    warnings.add("thinned", "density lowered from " + formatNumber(in.options.texelsPerMetre) + " to " +
                                formatNumber(layout.texelsPerMetre) + " texels/m by the budget of " +
                                formatCount(in.options.texelBudget) +
                                " texels: raise --texels, and --photons with it; or is the scene not in metres?");
  if (2 * tiny.count > layout.charts.size())
    warnings.add("tiny_charts",
                 formatCount(tiny.count) + " of " + formatCount(layout.charts.size()) +
                     " charts are much smaller than a texel and get one value each (" + formatPercent(tiny.areaShare) +
                     " of all surface): if they matter, raise --density" + (layout.thinned ? " and --texels" : ""));
}

/// Texels of a page take 20 bytes (r, g, b, photons, error) a side in the irradiance and some a direction in
/// the directional maps, each with a gutter of one texel. Empty space of pages is left out: it compresses to little.
std::uint64_t dlmBytes(const CheckInput& in) {
  constexpr std::uint64_t kLayerBytes = 4096, kSideBytes = 200,
                          kMapBytes = 16;  // of headers; of entries in the manifest
  const std::uint64_t meanTexel = in.options.moments ? kMeanBytes : 0;
  const auto mapTexel = static_cast<std::uint64_t>(bytesPerTexel(in.options.format.directional)) + meanTexel;
  const std::uint64_t atlasCoordinates = 3 * 2 * sizeof(float) * in.scene().triangles.size();
  const std::uint64_t layers = 5 + static_cast<std::uint64_t>(in.options.directions) * (in.options.moments ? 2 : 1);
  std::uint64_t bytes = in.glbBytes + atlasCoordinates + kLayerBytes * layers;
  for (const TallySide& side : in.plan.tallies.sides) {
    const std::uint64_t maps = in.plan.tallies.membersOf(side).members.size();
    const auto width = static_cast<std::uint64_t>(side.width + 2), height = static_cast<std::uint64_t>(side.height + 2);
    bytes += width * height * (20 + mapTexel * maps) + kSideBytes + kMapBytes * maps;
  }
  return bytes;
}

std::uint64_t mapBytes(const TallyLayout& tallies) {
  const std::uint64_t mapTexel = sizeof(Rgb) + (tallies.momentEntries > 0 ? sizeof(Vec3f) : 0);
  std::uint64_t bytes = 0;
  for (const TallySide& side : tallies.sides)
    bytes += side.texelCount() * (20 + mapTexel * tallies.membersOf(side).members.size());
  return bytes;
}

std::uint64_t freeDiskBytes() {
  std::error_code failed;
  const auto space = std::filesystem::space(".", failed);
  return failed ? 0 : space.available;
}

struct Needs {
  std::uint64_t memory, disk;
};

void warnOfResources(const Needs& needs, std::uint64_t memory, std::uint64_t disk, CheckWarnings& warnings,
                     CheckWarnings& failures) {
  if (needs.memory > memory)
    failures.add("memory", "the bake takes up to " + formatBytes(needs.memory) + " and " + formatBytes(memory) +
                               " are free; lower --density, --texels or --directions");
  if (needs.disk > disk)
    warnings.add("disk", "light maps and saved states take up to " + formatBytes(needs.disk) + " and " +
                             formatBytes(disk) + " are free in this folder");
}

}  // namespace

nlohmann::json checkLayout(const CheckInput& in, CheckWarnings& warnings) {
  const BakePlan& plan = in.plan;
  const auto directional = [&](const TallySide& s) { return !plan.tallies.membersOf(s).members.empty(); };
  const TinyCharts tiny = tinyCharts(in.scene(), plan);
  const auto density = densities(in.scene(), plan);
  warnOfLayout(in, tiny, warnings);
  for (const std::string& why : plan.charts.uv1Refused) warnings.add("uv1", why + ": charts are grown instead");
  return {{"charts", plan.charts.charts.size()},
          {"uv1_charts", plan.charts.uv1Charts},
          {"chart_sides", plan.tallies.sides.size()},
          {"sides_with_directions", std::count_if(plan.tallies.sides.begin(), plan.tallies.sides.end(), directional)},
          {"directions", in.options.directions},
          {"texels", plan.tallies.texels},
          {"covered_texels", coveredTexels(plan)},
          {"texels_per_metre", in.options.texelsPerMetre},
          {"texels_per_metre_used", plan.layout.texelsPerMetre},
          {"texels_per_metre_min", density.empty() ? 0 : density.front().first},
          {"texels_per_metre_median", medianDensity(density)},
          {"texels_per_metre_max", density.empty() ? 0 : density.back().first},
          {"thinned", plan.layout.thinned},
          {"mean_texel_mm", 1000 * meanTexel(in.scene(), plan)},
          {"largest_chart", largestChart(in.scene(), plan)},
          {"tiny_charts", tiny.count},
          {"tiny_charts_area_share", tiny.areaShare}};
}

nlohmann::json checkResources(const CheckInput& in, CheckWarnings& warnings, CheckWarnings& failures) {
  const std::uint64_t tallies = tallyBytes(in.plan, in.options);
  const std::uint64_t peak = predictMemory(in.options, in.scene(), in.plan, in.memory).peak();
  const std::uint64_t dlm = dlmBytes(in), states = 3 * (tallies + in.glbBytes);
  const std::uint64_t memory = availableMemoryBytes(), disk = freeDiskBytes();
  warnOfResources({peak, dlm + states}, memory, disk, warnings, failures);
  return {{"tally_bytes", tallies},
          {"expected_peak_memory_bytes", peak},
          {"free_memory_bytes", memory},
          {"map_bytes", mapBytes(in.plan.tallies)},
          {"dlm_bytes", dlm},
          {"checkpoint_bytes", states},
          {"free_disk_bytes", disk}};
}

}  // namespace lucarne
