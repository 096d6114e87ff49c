#include "app/bake_needs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "app/bake_scene.h"
#include "base/disk.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/units.h"
#include "dlm/mean_direction.h"

namespace lucarne {
namespace {

/// Texels that maps of the side take by direction; 0 where one irradiance map takes all.
std::uint64_t directionalTexels(const TallyLayout& tallies) {
  std::uint64_t sum = 0;
  for (const TallySide& side : tallies.sides) sum += side.texelCount() * tallies.membersOf(side).members.size();
  return sum;
}

/// While a side is resolved or its error estimated it takes some arrays a texel, and each thread has one side.
std::uint64_t sideScratch(const BakeOptions& options, const TallyLayout& tallies) {
  constexpr std::uint64_t kBytesPerTexel = 220;
  std::vector<std::uint64_t> sizes;
  for (const TallySide& side : tallies.sides) sizes.push_back(side.texelCount());
  std::sort(sizes.rbegin(), sizes.rend());
  sizes.resize(std::min(sizes.size(), static_cast<std::size_t>(threadCount(options))));
  std::uint64_t texels = 0;
  for (const std::uint64_t size : sizes) texels += size;
  const std::uint64_t levels = options.kernel.shape == KernelShape::adaptive ? 4 : 1;
  return levels * kBytesPerTexel * texels;
}

/// Contacts, and what is kept of each texel until the errors of all are known.
std::uint64_t contactBytes(const TallyLayout& tallies) { return 24 * tallies.texels; }

/// Lookup from triangles, and stacks and buffers of threads.
std::uint64_t lookupBytes(const BakeOptions& options, const Scene& scene) {
  constexpr std::uint64_t kTriangle = 32, kThread = std::uint64_t{1} << 20;
  return kTriangle * scene.triangles.size() + kThread * static_cast<std::uint64_t>(threadCount(options));
}

std::uint64_t ownTallies(const BakeOptions& options, const TallyLayout& tallies) {
  const PhotonRunOptions run = runOptions(options);
  return hasPrivateTallies(tallies, run) ? tallies.bytes() * static_cast<std::uint64_t>(run.threads - 1) : 0;
}

/// Light maps in memory; then, of one file at a time, all its pages with their gutters and empty corners.
std::uint64_t mapMaking(const BakeOptions& options, const Scene& scene, const TallyLayout& tallies) {
  constexpr std::uint64_t kTexel = 24, kTriangle = 150;
  constexpr double kPage = 1.25;  // pixels of pages a texel
  const std::uint64_t directional = directionalTexels(tallies);
  const std::uint64_t means = options.moments ? sizeof(Vec3f) * directional : 0;
  const std::uint64_t maps = kTexel * tallies.texels + sizeof(Rgb) * directional + means;
  const double irradiancePages = kPage * 24 * static_cast<double>(tallies.texels);
  const double directionalPages = kPage * 14 * static_cast<double>(directional);
  const std::uint64_t geometry = kTriangle * scene.triangles.size();
  const auto pages = static_cast<std::uint64_t>(std::max(irradiancePages, directionalPages));
  return maps + std::max(pages + geometry, sideScratch(options, tallies)) + contactBytes(tallies);
}

}  // namespace

MemorySoFar MemorySoFar::now() { return {residentMemoryBytes(), peakMemoryBytes()}; }

MemoryNeeds predictMemory(const BakeOptions& options, const Scene& scene, const BakePlan& plan, const MemorySoFar& soFar) {
  const TallyLayout& tallies = plan.tallies;
  MemoryNeeds needs;
  needs.earlier = soFar.peak;
  needs.base = soFar.resident + lookupBytes(options, scene);
  needs.tallies = tallyBytes(plan, options);
  needs.tracing = ownTallies(options, tallies) + contactBytes(tallies) + sideScratch(options, tallies);
  needs.maps = writesPart(options) && !options.report ? 0 : mapMaking(options, scene, tallies);
  return needs;
}

/// Texels of a page take 24 bytes (r, g, b, photons, two errors) a side in the irradiance and some a direction in the
/// directional maps, each with a gutter of one texel. Empty space of pages is left out: it compresses to little.
DiskNeeds predictDisk(const BakeOptions& options, const Scene& scene, const BakePlan& plan, std::uint64_t glbBytes) {
  constexpr std::uint64_t kLayerBytes = 4096, kSideBytes = 200,
                          kMapBytes = 16;  // of headers; of entries in the manifest
  constexpr std::uint64_t kPartHead = 65536;
  const std::uint64_t meanTexel = options.moments ? kMeanBytes : 0;
  const auto mapTexel = static_cast<std::uint64_t>(bytesPerTexel(options.format.directional)) + meanTexel;
  const std::uint64_t atlasCoordinates = 3 * 2 * sizeof(float) * scene.triangles.size();
  const std::uint64_t layers = 5 + static_cast<std::uint64_t>(options.directions) * (options.moments ? 2 : 1);
  DiskNeeds needs;
  needs.maps = glbBytes + atlasCoordinates + kLayerBytes * layers;
  for (const TallySide& side : plan.tallies.sides) {
    const std::uint64_t maps = plan.tallies.membersOf(side).members.size();
    const auto width = static_cast<std::uint64_t>(side.width + 2), height = static_cast<std::uint64_t>(side.height + 2);
    needs.maps += width * height * (24 + mapTexel * maps) + kSideBytes + kMapBytes * maps;
  }
  needs.state = tallyBytes(plan, options) + glbBytes + kPartHead;
  return needs;
}

std::uint64_t allowedMemory(const BakeOptions& options, int processes) {
  // What is resident already is no longer free.
  const std::uint64_t free = availableMemoryBytes() / static_cast<std::uint64_t>(processes) + residentMemoryBytes();
  return options.memoryBytes ? std::min(*options.memoryBytes, free) : free;
}

namespace {

/// The largest value of 1, 2, 3 … 9 tens of a power for which `fits`, below `from`; 0: none.
double largestFitting(double from, const std::function<bool(double)>& fits) {
  double low = 0, high = from;
  for (int step = 0; step < 12; ++step) {
    const double middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  if (low <= 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(low)) - 1);
  return std::floor(low / unit) * unit;
}

/// What would fit: "--density 7.5 or --directions 8". The next process will not hold the same memory to the byte before
/// its tallies, so that the advice leaves room for that.
std::string advice(const BakeOptions& options, const Scene& scene, const BakePlan& plan, const MemorySoFar& soFar,
                   std::uint64_t allowed) {
  constexpr std::uint64_t kSpread = 32;  // one part in so many
  const std::uint64_t aim = allowed - allowed / kSpread;
  const auto peakOf = [&](const BakeOptions& o) {
    const TexelLayout layout = layOutTexels(scene, plan.charts, {o.texelsPerMetre, o.texelBudget});
    DirectionSet directions(o.directions);
    TallyLayout tallies = planTallies(scene, plan.charts, layout, directions, tallyWishes(o));
    return predictMemory(o, scene, {{}, {}, std::move(directions), std::move(tallies)}, soFar).peak();
  };
  const double density = largestFitting(plan.layout.texelsPerMetre, [&](double d) {
    BakeOptions o = options;
    o.texelsPerMetre = d;
    return peakOf(o) <= aim;
  });
  const double directions = largestFitting(options.directions, [&](double n) {
    BakeOptions o = options;
    o.directions = std::max(1, static_cast<int>(n));
    return peakOf(o) <= aim;
  });
  std::string text;
  if (density > 0) text = "--density " + formatNumber(density);
  if (directions >= 1) text += (text.empty() ? "" : " or ") + ("--directions " + formatNumber(std::floor(directions)));
  return text.empty() ? "no density would: the scene alone takes " + formatBytes(soFar.peak) : text + " would fit";
}

}  // namespace

MemoryNeeds requireMemory(BakeOptions& options, const Scene& scene, const BakePlan& plan, const MemorySoFar& soFar,
                          std::uint64_t allowed) {
  MemoryNeeds needs = predictMemory(options, scene, plan, soFar);
  if (needs.peak() <= allowed) return needs;
  options.ownTallies = false;
  needs = predictMemory(options, scene, plan, soFar);
  if (needs.peak() <= allowed) return needs;
  throw Error(ExitCode::outOfResource,
              "the bake needs " + formatBytes(needs.peak()) + " of memory and " + formatBytes(allowed) +
                  (options.memoryBytes && allowed == *options.memoryBytes ? " are allowed (--memory)" : " are free") +
                  ": " + advice(options, scene, plan, soFar, allowed));
}

void requireDisk(const BakeOptions& options, const DiskNeeds& needs, std::uint64_t statesThere) {
  const bool saves = options.checkpointSeconds > 0, part = writesPart(options);
  const std::uint64_t both = 2 * needs.state, states = saves ? both - std::min(both, statesThere) : 0;
  const std::uint64_t maps = part ? 0 : needs.maps, parts = !saves && (part || options.keepPart) ? needs.state : 0;
  const auto require = [](std::uint64_t bytes, const std::filesystem::path& place, const std::string& what) {
    const std::optional<std::uint64_t> free = freeDiskBytes(place);
    if (bytes == 0 || !free || *free >= bytes) return;
    throw Error(ExitCode::outOfResource, what + " need " + formatBytes(bytes) + " on the disk of " + place.string() +
                                             " and " + formatBytes(*free) +
                                             " are free: make room or write elsewhere (-o)");
  };
  const std::filesystem::path folder = checkpointPath(options);
  if (onSameDisk(options.output, folder)) {
    require(maps + parts + states, options.output,
            part ? "the part and its saved states" : "light maps and two saved states");
  } else {
    require(maps + parts, options.output, part ? "parts" : "light maps");
    require(states, folder, "two saved states");
  }
}

}  // namespace lucarne
