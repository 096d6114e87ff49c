// The sink that counts photon hits in tallies.
//
// A deposit is a few adds at a random place: nearly all of its cost is the cache miss. So the last splats are held in a
// ring, their lines prefetched on entry, and added when they leave it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "base/huge_allocator.h"
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
    const std::uint16_t* rank;  // by ψ; null: one map takes all
  };
  /// `tallies` must outlive this.
  TexelMap(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const TallyLayout& tallies);
  const Entry& operator[](std::uint32_t triangle) const { return entries_[triangle]; }
  const Side& side(std::uint32_t i) const { return sides_[i]; }

 private:
  std::vector<Entry, HugeAllocator<Entry>> entries_;
  std::vector<Side> sides_;
};

/// Sums of what the sink stored, in tally units.
struct DepositSums {
  FluxSum incident;
  std::uint64_t storedHits = 0, clamped = 0;
};

/// One thread's sink. `shared`: other threads add to the same tallies (relaxed atomic adds), else plain adds. Flushed
/// by flush(), which must be called before the tallies are read.
template <bool shared>
class DepositSink {
 public:
  DepositSink(const TexelMap& map, const TallyLayout&, const DirectionSet& directions, LightPart part,
              const Tallies& tallies)
      : map_(map),
        directions_(directions),
        part_(part),
        light_(tallies.light().data()),
        statistics_(tallies.statistics().data()) {}

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
    const std::uint64_t rank =
        side.rank == nullptr ? 0 : side.rank[static_cast<std::size_t>(directions_.nearest(h.wi))];
    splat(side.firstLight + rank * side.texelCount + texel, side.firstTexel + texel, h);
  }

  void endPhoton() {
    // One photon may come back to a texel; its share is squared as a whole.
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (path_[i].texel == kTaken) continue;
      float sum = path_[i].luminance;
      for (std::size_t j = i + 1; j < path_.size(); ++j) {
        if (path_[j].texel != path_[i].texel) continue;
        sum += path_[j].luminance;
        path_[j].texel = kTaken;
      }
      count(statistics_ + path_[i].texel * kStatisticsChannels,
            roundUnits(std::min(sum * sum, kLargestSquare), path_[i].word),
            odd_ ? roundUnits(sum, path_[i].word >> 8) : 0);
    }
    path_.clear();
    sums_.incident += incident_;
    incident_ = {};
  }

  void flush() {
    for (Pending& p : ring_) {
      apply(p);
      p.at = nullptr;
    }
    for (PendingCount& p : counts_) {
      apply(p);
      p.at = nullptr;
    }
  }
  DepositSums sums() const {
    DepositSums all = sums_;
    all.incident += incident_;
    return all;
  }
  /// Between photons: counts from zero again.
  void resetSums() { sums_ = {}; }

 private:
  static constexpr std::uint64_t kTaken = ~std::uint64_t{0};
  static constexpr float kLargestSquare = 0x1p30f;  // times 2^32 still fits 63 bits
  struct Pending {
    std::int64_t* at = nullptr;
    std::array<std::int64_t, 3> units{};
  };
  struct PendingCount {
    std::int64_t* at = nullptr;
    std::int64_t m2 = 0, odd = 0;
  };
  struct PathHit {
    std::uint64_t texel;
    float luminance;
    std::uint32_t word;  // for rounding
  };

  static void add(std::int64_t* p, std::int64_t v) {
    if constexpr (shared)
      std::atomic_ref<std::int64_t>(*p).fetch_add(v, std::memory_order_relaxed);
    else
      *p += v;
  }

  /// Light as the shading normal receives it (see shadingReception), clamped.
  Rgb received(const PhotonHit& h) {
    if (h.ns == h.n) return h.beta;
    float factor = shadingReception(h.wi, h.n, h.ns);
    if (factor > kLargestShadingCorrection) {
      factor = kLargestShadingCorrection;
      ++sums_.clamped;
    }
    return h.beta * factor;
  }

  [[gnu::always_inline]] void splat(std::uint64_t entry, std::uint64_t texel, const PhotonHit& h) {
    const Rgb value = received(h);
    Pending& slot = ring_[head_];
    head_ = (head_ + 1) % ring_.size();
    apply(slot);
    slot.at = light_ + entry * kLightChannels;
    __builtin_prefetch(slot.at, 1);
    __builtin_prefetch(slot.at + 2, 1);
    __builtin_prefetch(statistics_ + texel * kStatisticsChannels, 1);
    const std::int64_t r = roundUnits(value.x, h.words[0]), g = roundUnits(value.y, h.words[1]),
                       b = roundUnits(value.z, h.words[2]);
    slot.units = {r, g, b};
    incident_.units = {incident_.units[0] + r, incident_.units[1] + g, incident_.units[2] + b};
    ++sums_.storedHits;
    odd_ = h.odd;
    path_.push_back({texel, luminance(value), h.words[3]});
  }
  void count(std::int64_t* at, std::int64_t m2, std::int64_t odd) {
    PendingCount& slot = counts_[countHead_];
    countHead_ = (countHead_ + 1) % counts_.size();
    apply(slot);
    slot = {at, m2, odd};
  }
  static void apply(const PendingCount& p) {
    if (p.at == nullptr) return;
    add(p.at + kCount, 1);
    add(p.at + kSquares, p.m2);
    if (p.odd != 0) add(p.at + kOdd, p.odd);
  }
  static void apply(const Pending& p) {
    if (p.at == nullptr) return;
    for (std::size_t c = 0; c < 3; ++c) add(p.at + c, p.units[c]);
  }

  const TexelMap& map_;
  const DirectionSet& directions_;
  LightPart part_;
  std::int64_t* light_;
  std::int64_t* statistics_;
  std::array<Pending, 16> ring_{};
  std::array<PendingCount, 16> counts_{};
  std::size_t head_ = 0, countHead_ = 0;
  bool odd_ = false;  // the photon in flight
  std::vector<PathHit> path_;
  FixedRgb incident_;  // of the photon in flight; 64 bits hold any single path
  DepositSums sums_;
};

}  // namespace lucarne
