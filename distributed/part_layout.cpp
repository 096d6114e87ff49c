#include "distributed/part_layout.h"

#include <array>
#include <bit>
#include <limits>

#include "base/json.h"

namespace lucarne {
namespace {

constexpr const char* kAttribute = "lucarne";
constexpr const char* kSealMark = "LUCSEAL1";

int rowsFor(std::uint64_t pixels, const std::string& file) {
  const std::uint64_t rows = (pixels + kPartWidth - 1) / kPartWidth;
  if (rows > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
    throw PartError(file + " is larger than a part can be");
  }
  return std::max(1, static_cast<int>(rows));
}

/// Where channel c of a pixel stands in the alphabetical order of its row: its high word, then its low word.
constexpr std::array<std::size_t, 3> kLightPlaces = {2, 1, 0};  // r, g, b stand as b, g, r
constexpr std::array<std::size_t, 3> kOtherPlaces = {0, 1, 2};  // count, m2, odd; x, y, z

constexpr std::size_t placeOf(PartLayer layer, std::size_t channel) {
  return isLight(layer) ? kLightPlaces[channel] : kOtherPlaces[channel];
}

/// One channel at a time over a row of constant length, which compilers turn into vector code.
template <std::size_t channels, class F>
void forChannels(PartLayer layer, F&& f) {
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t high = 2 * placeOf(layer, c) * kPartWidth;
    f(c, high, high + kPartWidth);
  }
}

template <std::size_t channels>
void split(PartLayer layer, const std::int64_t* values, std::size_t pixels, std::uint32_t* row) {
  forChannels<channels>(layer, [&](std::size_t c, std::size_t high, std::size_t low) {
    for (std::size_t x = 0; x < pixels; ++x) {
      const auto v = static_cast<std::uint64_t>(values[x * channels + c]);
      row[high + x] = static_cast<std::uint32_t>(v >> 32);
      row[low + x] = static_cast<std::uint32_t>(v);
    }
  });
}

template <std::size_t channels>
void join(PartLayer layer, const std::uint32_t* row, std::size_t pixels, std::int64_t* values) {
  forChannels<channels>(layer, [&](std::size_t c, std::size_t high, std::size_t low) {
    for (std::size_t x = 0; x < pixels; ++x)
      values[x * channels + c] = static_cast<std::int64_t>(std::uint64_t{row[high + x]} << 32 | row[low + x]);
  });
}

}  // namespace

ExrRows partRows(const PartHeader& header, const std::string& file) {
  std::vector<ExrRowsLayer> layers = {{"scene", {"bytes"}, rowsFor((header.sceneBytes + 3) / 4, file)}};
  const auto addSet = [&](const std::string& name) {
    layers.push_back(
        {name + ".light", {"b.hi", "b.lo", "g.hi", "g.lo", "r.hi", "r.lo"}, rowsFor(header.lightEntries, file)});
    layers.push_back({name + ".statistics",
                      {"count.hi", "count.lo", "m2.hi", "m2.lo", "odd.hi", "odd.lo"},
                      rowsFor(header.texels, file)});
    if (header.momentEntries == 0) return;
    layers.push_back(
        {name + ".moments", {"x.hi", "x.lo", "y.hi", "y.lo", "z.hi", "z.lo"}, rowsFor(header.momentEntries, file)});
  };
  addSet("photons");
  if (header.direct) addSet("direct");
  return ExrRows(kPartWidth, std::move(layers), kAttribute,
                 toJson(header).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::vector<PartTallies> partTallies(const PartHeader& header) {
  std::vector<PartTallies> all;
  const auto add = [&](PartLayer layer, std::uint64_t pixels) { all.push_back({layer, all.size() + 1, pixels}); };
  const auto addSet = [&](PartLayer light, PartLayer statistics, PartLayer moments) {
    add(light, header.lightEntries);
    add(statistics, header.texels);
    if (header.momentEntries > 0) add(moments, header.momentEntries);
  };
  addSet(PartLayer::light, PartLayer::statistics, PartLayer::moments);
  if (header.direct) addSet(PartLayer::directLight, PartLayer::directStatistics, PartLayer::directMoments);
  return all;
}

void splitRow(PartLayer layer, std::span<const std::int64_t> values, std::span<std::uint32_t> row) {
  const std::size_t pixels = values.size() / kPartChannels;
  split<kPartChannels>(layer, values.data(), pixels, row.data());
}

void joinRow(PartLayer layer, std::span<const std::uint32_t> row, std::span<std::int64_t> values) {
  const std::size_t pixels = values.size() / kPartChannels;
  join<kPartChannels>(layer, row.data(), pixels, values.data());
}

std::string partSeal(const Hash128& hash) { return kSealMark + hash.hex().substr(0, 16); }

}  // namespace lucarne
