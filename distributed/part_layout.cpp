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

/// Where channel c of a pixel stands in the alphabetical order of its row.
constexpr std::array<std::size_t, 3> kLightPlaces = {2, 1, 0};  // r, g, b stand as b, g, r
constexpr std::array<std::size_t, 3> kStatisticsPlaces = {0, 1, 0};

constexpr std::size_t placeOf(PartLayer layer, std::size_t channel) {
  return layer == PartLayer::light ? kLightPlaces[channel] : kStatisticsPlaces[channel];
}

/// One channel at a time, with constant strides, which compilers turn into vector code.
template <std::size_t channels, std::size_t words>
void split(PartLayer layer, std::span<const std::int64_t> values, std::uint32_t* row) {
  const std::size_t pixels = values.size() / channels;
  for (std::size_t c = 0; c < channels; ++c) {
    std::uint32_t* word = row + placeOf(layer, c) * words * kPartWidth;
    for (std::size_t x = 0; x < pixels; ++x) {
      const auto v = static_cast<std::uint64_t>(values[x * channels + c]);
      word[x + (words - 1) * kPartWidth] = static_cast<std::uint32_t>(v);
      if constexpr (words == 2) word[x] = static_cast<std::uint32_t>(v >> 32);
    }
  }
}

template <std::size_t channels, std::size_t words>
void join(PartLayer layer, const std::uint32_t* row, std::span<std::int64_t> values) {
  const std::size_t pixels = values.size() / channels;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::uint32_t* word = row + placeOf(layer, c) * words * kPartWidth;
    for (std::size_t x = 0; x < pixels; ++x) {
      std::uint64_t v = word[x + (words - 1) * kPartWidth];
      if constexpr (words == 2) v |= std::uint64_t{word[x]} << 32;
      values[x * channels + c] = static_cast<std::int64_t>(v);
    }
  }
}

/// "b.hi", "b.lo", … or "b.lo", …
std::vector<std::string> channelNames(std::initializer_list<const char*> names, int words) {
  std::vector<std::string> all;
  for (const std::string name : names) {
    if (words == 2) all.push_back(name + ".hi");
    all.push_back(name + ".lo");
  }
  return all;
}

}  // namespace

ExrRows partRows(const PartHeader& header, const std::string& file) {
  return ExrRows(kPartWidth,
                 {{"scene", {"bytes"}, rowsFor((header.sceneBytes + 3) / 4, file)},
                  {"photons.light", channelNames({"b", "g", "r"}, header.lightWords), rowsFor(header.lightEntries, file)},
                  {"photons.statistics", channelNames({"count", "m2"}, header.statisticsWords), rowsFor(header.texels, file)}},
                 kAttribute, toJson(header).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

int wordsOf(const PartHeader& header, PartLayer layer) {
  return layer == PartLayer::light ? header.lightWords : header.statisticsWords;
}

void splitRow(PartLayer layer, int words, std::span<const std::int64_t> values, std::span<std::uint32_t> row) {
  if (layer == PartLayer::light) {
    words == 2 ? split<3, 2>(layer, values, row.data()) : split<3, 1>(layer, values, row.data());
  } else {
    words == 2 ? split<2, 2>(layer, values, row.data()) : split<2, 1>(layer, values, row.data());
  }
}

void joinRow(PartLayer layer, int words, std::span<const std::uint32_t> row, std::span<std::int64_t> values) {
  if (layer == PartLayer::light) {
    words == 2 ? join<3, 2>(layer, row.data(), values) : join<3, 1>(layer, row.data(), values);
  } else {
    words == 2 ? join<2, 2>(layer, row.data(), values) : join<2, 1>(layer, row.data(), values);
  }
}

std::string partSeal(const Hash128& hash) { return kSealMark + hash.hex().substr(0, 16); }

}  // namespace lucarne
