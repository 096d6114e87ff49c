// Parts made by hand: numbers of a fixed stream in every field, and part files as bytes to spoil.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "distributed/part_file.h"

namespace lucarne::test {

inline constexpr std::int64_t kMostTally = std::numeric_limits<std::int64_t>::max();

/// SplitMix64: the same numbers on every machine.
class NumberStream {
 public:
  explicit NumberStream(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
  }
  /// 0 … largest, both included; `largest` below 2^64 − 1.
  std::uint64_t upTo(std::uint64_t largest) { return next() % (largest + 1); }

 private:
  std::uint64_t state_;
};

inline Tallies madeUpTallies(std::uint64_t lightEntries, std::uint64_t texels, std::uint64_t seed,
                             std::int64_t largest = 1'000'000'000'000) {
  Tallies tallies(lightEntries, texels);
  NumberStream numbers(seed);
  for (const auto span : {tallies.light(), tallies.statistics()})
    for (std::int64_t& v : span) v = static_cast<std::int64_t>(numbers.upTo(static_cast<std::uint64_t>(largest)));
  return tallies;
}

inline std::vector<std::uint8_t> madeUpScene(std::size_t size) {
  std::vector<std::uint8_t> bytes;
  NumberStream numbers(size);
  while (bytes.size() < size) bytes.push_back(static_cast<std::uint8_t>(numbers.next()));
  return bytes;
}

inline Ledger madeUpLedger(std::uint64_t photons, std::uint64_t seed) {
  Ledger ledger;
  NumberStream numbers(seed);
  for (FluxSum* sum :
       {&ledger.emitted, &ledger.absorbed, &ledger.escaped, &ledger.cutOff, &ledger.expectedAbsorbed, &ledger.incident})
    for (Int128& units : sum->units) units = static_cast<Int128>(numbers.upTo(1'000'000'000'000));
  for (FluxSum* sum : {&ledger.roulette, &ledger.shadingNormal})
    for (Int128& units : sum->units) units = static_cast<Int128>(numbers.upTo(1000)) - 500;
  for (std::uint64_t* count : {&ledger.rays, &ledger.hits, &ledger.storedHits, &ledger.cutOffPaths,
                               &ledger.repeatedRays, &ledger.clampedNormals, &ledger.strayValues})
    *count = numbers.upTo(1'000'000);
  ledger.absorptionErrorSquares = static_cast<Int128>(numbers.next()) * 1'000'003;
  ledger.photons = photons;
  return ledger;
}

/// Of a bake of 1000 photons in 4 parts; makers, name, times and ledger differ by seed, the identity does not.
inline PartHeader madeUpHeader(const IndexSet& photons, std::span<const std::uint8_t> scene, std::uint64_t seed = 0) {
  PartHeader h;
  NumberStream numbers(seed + 1);
  h.sceneName = "room-" + std::to_string(seed) + ".glb";
  h.identity.scene = hashBytes(scene);
  h.identity.settings = {{"seed", 7}, {"texels_per_metre", 16.5}, {"light", "all"}, {"keep_all_directions", false}};
  h.identity.resolve = {{"kernel", "pyramid"}, {"kernel_width", 1.5}};
  h.identity.layout = {0x0123456789abcdef, 42};
  h.identity.emittedFlux = 1234.5678901234567;
  h.makers = {{"lucarne 0.1.0 00000000", "Embree, avx2", "processor " + std::to_string(seed % 3), {seed % 3, 1}}};
  h.planned = {1000, 4};
  h.photons = photons;
  h.ledger = madeUpLedger(photons.count(), seed);
  h.microseconds = numbers.upTo(1'000'000);
  return h;
}

struct MadeUpPart {
  PartHeader header;
  std::vector<std::uint8_t> scene;
  Tallies tallies;
  void write(const std::filesystem::path& path) const { writePart(path, header, scene, tallies); }
};

inline MadeUpPart madeUpPart(IndexRange photons, std::uint64_t lightEntries = 10, std::uint64_t texels = 7,
                             std::size_t sceneBytes = 100, std::uint64_t seed = 0) {
  std::vector<std::uint8_t> scene = madeUpScene(sceneBytes);
  PartHeader header = madeUpHeader(IndexSet(photons), scene, seed);
  return {std::move(header), std::move(scene), madeUpTallies(lightEntries, texels, seed)};
}

inline std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void setBytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The beginning of a part with any text for a header, and `more` behind it.
inline std::string forgedPart(const std::string& text, const std::string& more = std::string(500, '\0')) {
  const std::uint32_t start[] = {20000630, 2 | 0x1000}, length = static_cast<std::uint32_t>(text.size());
  std::string bytes(sizeof(start), '\0'), size(sizeof(length), '\0');
  std::memcpy(bytes.data(), start, sizeof(start));
  std::memcpy(size.data(), &length, sizeof(length));
  return bytes + "lucarne" + '\0' + "string" + '\0' + size + text + more;
}

/// Whole, as if its last 24 bytes had been computed over what stands before them now.
inline std::string resealed(const std::string& part) {
  const std::string body = part.substr(0, part.size() - kSealBytes);
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(body)));
  return body + partSeal(hasher.finish());
}

/// What reading the whole file says against it, which must be a PartError that names it; "" when it is taken.
inline std::string refusalOf(const std::filesystem::path& path) {
  try {
    PartReader(path).stream({});
    return "";
  } catch (const PartError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another kind of error: " << error.what();
    return error.what();
  }
}

}  // namespace lucarne::test
