// Direct light, gathered: every texel looks for lamps and sky from places on its own surface, where photons would have
// to find the texel.
//
// Sample s of a texel is a pure function of (seed, texel, s): a place uniform over the surface inside the texel, and
// the direct light there by next-event estimation and a cosine-sampled ray, joined by multiple importance sampling
// (path_tracer.h). Light that comes through glass or from a mirror is not direct: photons bring it.
//
// Tallies of this set:   light       Σ over samples of E·α·surface/area, in units of 2^-24 of directUnit()
//                        statistics  samples that found light, Σ (luminance of a sample)², and Σ luminance of those
//                                    of odd index, units of 2^-24
//                        moments     (where there are any) of the light above, as in tally.h
// so that the mean over samples times area(t') is what resolve.h calls tally(t').
#pragma once

#include "dlm/tally.h"
#include "dlm/texel_gather.h"
#include "dlm/texel_surface.h"
#include "tracer/transport/path_tracer.h"

namespace lucarne {

/// Samples a texel at most, and the largest value that one may add: three of them in each sample still fit 63 bits.
/// A value beyond, millimetres from a bulb, is cut there and counted.
inline constexpr std::uint64_t kMostDirectSamples = std::uint64_t{1} << 20;
inline constexpr float kLargestDirectValue = 0x1p16f;

/// What happened while gathering. Integers: sums have no order.
struct DirectCounts {
  std::uint64_t places = 0;       // that were looked from
  std::uint64_t clamped = 0;      // values cut at kLargestDirectValue
  std::uint64_t strayValues = 0;  // not finite or negative, dropped
  DirectCounts& operator+=(const DirectCounts& o) {
    places += o.places;
    clamped += o.clamped;
    strayValues += o.strayValues;
    return *this;
  }
  friend bool operator==(const DirectCounts&, const DirectCounts&) = default;
};

/// lx that a value of 1 stands for: emitted flux (lm) over all surface that has texels.
double directUnit(double emittedFlux, const TexelLayout& layout, double metresPerLocal);

class DirectGather {
 public:
  /// `scene` and what it refers to must outlive this.
  DirectGather(const GatherScene& scene, const PhotonSeed& seed);

  /// Adds samples begin to end of every texel with surface to the second set of `tallies`, with the threads of the
  /// arena that it is called in. The result depends on neither threads nor cuts.
  DirectCounts gather(IndexRange samples, const Tallies& tallies) const;

 private:
  class Texel;
  DirectCounts gatherTile(const TexelTile& tile, IndexRange samples, const Tallies& set) const;

  GatherScene in_;
  PhotonSeed seed_;
  PathTracer paths_;
  double unit_;
  std::vector<TexelTile> tiles_;
};

}  // namespace lucarne
