// The sink that counts photon hits in tallies.
//
// A deposit is a few adds at a random place: nearly all of its cost is the miss of the cache and of the page table. So
// deposits are held back and added a group at a time, and memory is asked for some deposits ahead: the misses of many
// overlap.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "base/huge_allocator.h"
#include "dlm/direction_shares.h"
#include "dlm/tally.h"
#include "tracer/transport/photon_hit.h"
#include "tracer/transport/shading_normal.h"

namespace lucarne {

enum class LightPart : std::uint8_t { all, direct, indirect };

/// Where each triangle lies in texels, and which sides take its light. Built once, shared by all threads.
class TexelMap {
 public:
  struct alignas(32) Entry {
    Vec2f st0, e1, e2;          // texel coordinates of corner 0, edges to corners 1 and 2
    std::uint32_t front, back;  // sides, kNone: none
  };
  struct Side {  // of TallyLayout::sides what a deposit reads
    int width, height;
    std::uint64_t firstLight, firstTexel, texelCount;
    std::uint64_t firstMoment;
    const std::uint16_t* rank;  // by ψ; null: one map takes all
  };
  /// `tallies` must outlive this.
  TexelMap(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const TallyLayout& tallies);
  const Entry& operator[](std::uint32_t triangle) const { return entries_[triangle]; }
  const Side& side(std::uint32_t i) const { return sides_[i]; }
  /// ψ by rank of a side with maps by direction.
  const std::uint16_t* members(std::uint32_t i) const { return members_[i]; }

 private:
  std::vector<Entry, HugeAllocator<Entry>> entries_;
  std::vector<Side> sides_;
  std::vector<const std::uint16_t*> members_;  // by side; only shared hits read it
};

/// Sums of what the sink stored, in tally units.
struct DepositSums {
  FluxSum incident;
  std::uint64_t storedHits = 0, clamped = 0;
};

/// One thread's sink. `shared`: other threads add to the same tallies (relaxed atomic adds), else plain adds. `moments`:
/// the tallies have them. `linear`: a hit is shared among directions, as directionShares() tells; the texel's sum over ψ, and
/// its statistics, are the same numbers as without. Flushed by flush(), which must be called before the tallies are read.
template <bool shared, bool moments = false, bool linear = false>
class DepositSink {
 public:
  DepositSink(const TexelMap& map, const TallyLayout&, const DirectionSet& directions, LightPart part,
              const Tallies& tallies)
      : map_(map),
        directions_(directions),
        part_(part),
        light_(tallies.light().data()),
        statistics_(tallies.statistics().data()),
        moments_(tallies.moments().data()) {}

  /// What a hit on the triangle will read is asked for early.
  void prefetch(std::uint32_t triangle) const { __builtin_prefetch(&map_[triangle]); }

  [[gnu::always_inline]] void hit(const PhotonHit& h) {
    if (part_ != LightPart::all && (part_ == LightPart::direct) != (h.event == 1)) return;
    const TexelMap::Entry& entry = map_[h.hit.triangle];
    const std::uint32_t sideIndex = h.hit.back ? entry.back : entry.front;
    if (sideIndex == kNone) return;
    const TexelMap::Side& side = map_.side(sideIndex);
    const Vec2f st = entry.st0 + entry.e1 * h.hit.b.x + entry.e2 * h.hit.b.y;
    const int x = std::min(std::max(static_cast<int>(st.x), 0), side.width - 1);
    const int y = std::min(std::max(static_cast<int>(st.y), 0), side.height - 1);
    const auto texel =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(side.width) + static_cast<std::uint64_t>(x);
    const Rgb value = received(h);
    if constexpr (linear) {
      if (side.rank != nullptr) {
        holdShares(side, directionShares(directions_, side.rank, map_.members(sideIndex), h.wi), texel, value, h);
        return;
      }
    }
    const std::uint64_t rank =
        side.rank == nullptr ? 0 : side.rank[static_cast<std::size_t>(directions_.nearest(h.wi))];
    hold(side.firstLight + rank * side.texelCount + texel, side.firstTexel + texel, value, h);
    if constexpr (moments) {
      if (side.rank != nullptr) holdMoment(side.firstMoment + rank * side.texelCount + texel, luminance(value), h);
    }
  }

  [[gnu::always_inline]] void endPhoton() {
    if (mayReturn_) mergeReturns();
    mayReturn_ = false;
    texels_ = 0;
    firstOfPhoton_ = held_.size();
    if (held_.size() >= kGroup) addHeld();
  }

  void flush() { addHeld(); }
  DepositSums sums() const {
    DepositSums all = sums_;
    all.incident += incident_;
    return all;
  }
  /// Between photons: counts from zero again.
  void resetSums() {
    sums_ = {};
    incident_ = {};
  }

 private:
  static constexpr std::uint64_t kTaken = ~std::uint64_t{0};
  static constexpr float kLargestSquare = 0x1p30f;  // times 2^32 still fits 63 bits
  static constexpr std::size_t kGroup = 64, kAhead = 16;
  static constexpr std::uint32_t kOddBit = 0x80000000u;
  struct Held {
    std::uint64_t entry;
    std::array<std::int64_t, 3> units;
    std::uint64_t texel;  // kTaken: counted by an earlier hit of the photon
    float luminance;      // all that the photon brings to the texel
    std::uint32_t word;   // for rounding; its top bit says that the photon is an odd one
  };
  struct HeldMoment {
    std::uint64_t entry;
    std::array<std::int64_t, 3> units;
  };

  static void add(std::int64_t* p, std::int64_t v) {
    if constexpr (shared)
      std::atomic_ref<std::int64_t>(*p).fetch_add(v, std::memory_order_relaxed);
    else
      *p += v;
  }

  /// Light as the shading normal receives it (see shadingReception), clamped.
  Rgb received(const PhotonHit& h) {
    if (!h.hit.smooth || h.ns == h.n) return h.beta;
    float factor = shadingReception(h.wi, h.n, h.ns);
    if (factor > kLargestShadingCorrection) {
      factor = kLargestShadingCorrection;
      ++sums_.clamped;
    }
    return h.beta * factor;
  }

  [[gnu::always_inline]] void hold(std::uint64_t entry, std::uint64_t texel, const Rgb& value, const PhotonHit& h) {
    holdUnits(entry, texel, unitsOf(value, h), value, h);
  }

  [[gnu::always_inline]] static std::array<std::int64_t, 3> unitsOf(const Rgb& value, const PhotonHit& h) {
    return {roundUnits(value.x, h.words[0]), roundUnits(value.y, h.words[1]), roundUnits(value.z, h.words[2])};
  }

  [[gnu::always_inline]] void holdUnits(std::uint64_t entry, std::uint64_t texel,
                                        const std::array<std::int64_t, 3>& units, const Rgb& value,
                                        const PhotonHit& h) {
    const auto [r, g, b] = units;
    incident_.units = {incident_.units[0] + r, incident_.units[1] + g, incident_.units[2] + b};
    ++sums_.storedHits;
    held_.push_back({entry, {r, g, b}, texel, luminance(value), (h.words[3] & ~kOddBit) | (h.odd ? kOddBit : 0u)});
    const std::uint64_t bit = std::uint64_t{1} << (texel * 0x9E3779B97F4A7C15u >> 58);
    mayReturn_ |= (texels_ & bit) != 0;
    texels_ |= bit;
  }

  /// The light took the lowest 8 bits of the words.
  static std::array<std::int64_t, 3> momentUnits(float light, const PhotonHit& h) {
    const Vec3f m = momentOf(light, h.wi);
    return {roundUnits(m.x, h.words[0] >> 8), roundUnits(m.y, h.words[1] >> 8), roundUnits(m.z, h.words[2] >> 8)};
  }
  void holdMoment(std::uint64_t entry, float light, const PhotonHit& h) {
    heldMoments_.push_back({entry, momentUnits(light, h)});
  }

  /// The whole in units is what the filter `nearest` adds to one map; the highest 16 bits of the words split it. The first
  /// part counts the photon, for all.
  void holdShares(const TexelMap::Side& side, const DirectionShares& shares, std::uint64_t texel, const Rgb& value,
                  const PhotonHit& h) {
    const std::array<std::int64_t, 3> whole = unitsOf(value, h);
    const auto light = splitChannels(shares, whole, h);
    holdUnits(side.firstLight + shares.rank[0] * side.texelCount + texel, side.firstTexel + texel, whole, value, h);
    held_.back().units = partOf(light, 0);
    for (std::size_t k = 1; k < 3; ++k)
      if (shares.upTo[k] > shares.upTo[k - 1])
        held_.push_back({side.firstLight + shares.rank[k] * side.texelCount + texel, partOf(light, k), kTaken, 0, 0});
    if constexpr (moments) {
      const auto moment = splitChannels(shares, momentUnits(luminance(value), h), h);
      for (std::size_t k = 0; k < 3; ++k)
        if (k == 0 || shares.upTo[k] > shares.upTo[k - 1])
          heldMoments_.push_back({side.firstMoment + shares.rank[k] * side.texelCount + texel, partOf(moment, k)});
    }
  }
  /// [channel][share].
  using Parts = std::array<std::array<std::int64_t, 3>, 3>;
  static Parts splitChannels(const DirectionShares& shares, const std::array<std::int64_t, 3>& units,
                             const PhotonHit& h) {
    return {shares.split(units[0], h.words[0] >> 16), shares.split(units[1], h.words[1] >> 16),
            shares.split(units[2], h.words[2] >> 16)};
  }
  static std::array<std::int64_t, 3> partOf(const Parts& parts, std::size_t k) {
    return {parts[0][k], parts[1][k], parts[2][k]};
  }

  /// One photon may come back to a texel; its share is squared as a whole.
  [[gnu::noinline]] void mergeReturns() {
    for (std::size_t i = firstOfPhoton_; i < held_.size(); ++i) {
      if (held_[i].texel == kTaken) continue;
      for (std::size_t j = i + 1; j < held_.size(); ++j) {
        if (held_[j].texel != held_[i].texel) continue;
        held_[i].luminance += held_[j].luminance;
        held_[j].texel = kTaken;
      }
    }
  }

  /// Memory of hits to come is asked for while those before them are added: the processor by itself looks only a few adds
  /// ahead, and locked ones it takes one by one.
  [[gnu::noinline]] void addHeld() {
    const std::size_t count = held_.size();
    for (std::size_t i = 0; i < std::min(kAhead, count); ++i) prefetchHeld(held_[i]);
    for (std::size_t i = 0; i < count; ++i) {
      if (i + kAhead < count) prefetchHeld(held_[i + kAhead]);
      addHeld(held_[i]);
    }
    if constexpr (moments) addHeldMoments();
    held_.clear();
    firstOfPhoton_ = 0;
    sums_.incident += incident_;
    incident_ = {};
  }
  [[gnu::always_inline]] void addHeld(const Held& h) {
    std::int64_t* light = light_ + h.entry * kLightChannels;
    for (std::size_t c = 0; c < 3; ++c) add(light + c, h.units[c]);
    if (h.texel == kTaken) return;
    std::int64_t* statistics = statistics_ + h.texel * kStatisticsChannels;
    add(statistics + kCount, 1);
    add(statistics + kSquares, roundUnits(std::min(h.luminance * h.luminance, kLargestSquare), h.word));
    const std::int64_t odd = -static_cast<std::int64_t>((h.word & kOddBit) != 0);
    add(statistics + kOdd, roundUnits(h.luminance, h.word >> 8) & odd);
  }
  /// One line of each is asked for: the page is what takes long to find, and a second line is needed by one in four only.
  [[gnu::always_inline]] void prefetchHeld(const Held& h) const {
    __builtin_prefetch(light_ + h.entry * kLightChannels, 1);
    if (h.texel != kTaken) __builtin_prefetch(statistics_ + h.texel * kStatisticsChannels, 1);
  }
  void addHeldMoments() {
    const std::size_t count = heldMoments_.size();
    const auto place = [this](std::size_t i) { return moments_ + heldMoments_[i].entry * kMomentChannels; };
    for (std::size_t i = 0; i < std::min(kAhead, count); ++i) __builtin_prefetch(place(i), 1);
    for (std::size_t i = 0; i < count; ++i) {
      if (i + kAhead < count) __builtin_prefetch(place(i + kAhead), 1);
      for (std::size_t c = 0; c < 3; ++c) add(place(i) + c, heldMoments_[i].units[c]);
    }
    heldMoments_.clear();
  }

  const TexelMap& map_;
  const DirectionSet& directions_;
  LightPart part_;
  std::int64_t* light_;
  std::int64_t* statistics_;
  std::int64_t* moments_;
  std::vector<HeldMoment> heldMoments_;
  std::vector<Held> held_;  // whole photons, and that in flight
  std::size_t firstOfPhoton_ = 0;
  std::uint64_t texels_ = 0;  // of the photon in flight: a bit by hash for each
  bool mayReturn_ = false;    // two of them had the same bit
  FixedRgb incident_;         // of what is held: 64 bits hold the longest path and a group (beta ≤ 2^24)
  DepositSums sums_;
};

}  // namespace lucarne
