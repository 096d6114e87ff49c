// Resolve: tallies become light maps.
//
//   value(t) = Σ k(t,t')·tally(t') / Σ k(t,t')·open area(t')
//
// open area(t') is the surface inside texel t' that light can reach, and the sums are over the t' that no geometry
// separates from t (texel_contacts.h). A constant irradiance E gives tallies E·open area(t') on average, hence
// value E at every texel up to the chart's edge, and up to the foot of a wall. Texels without surface but within the kernel of some are extrapolated by the same formula;
// the others copy the nearest that has a value. The physical scale enters here, once, in double: one tally unit is
// 2^-24 · emitted flux / photons. Where direct light was gathered (direct_gather.h), its set has tally(t') = area(t') ·
// mean over its samples, and the two sets are added; so are the variances (texel_error.h).
//
// Moments go the same way with the same weights, so that the mean direction of a texel is that of the light which its
// value is made of.
#pragma once

#include "dlm/kernel.h"
#include "dlm/light_maps.h"
#include "dlm/tally.h"
#include "dlm/texel_contacts.h"

namespace lucarne {

struct ResolveInput {
  const Scene& scene;
  const ChartSet& charts;
  const TexelLayout& layout;
  const TallyLayout& tallyLayout;
  const Tallies& tallies;
  int directionCount;
  double emittedFlux;     // lm: EmitterTable::totalFlux()
  std::uint64_t photons;  // traced; 0 gives black maps
  std::uint64_t samples = 0;  // of the second set of the tallies; 0: nothing of it counts
  std::uint64_t oddSamples = 0;  // those of odd index among them
  std::span<const SideContacts> contacts = {};  // by side, as findContacts() finds them; empty: as if there were none
};

/// What an adaptive kernel is estimated to blur: Σ area·E, and Σ area·|bias of E|, luminance.
struct KernelBias {
  double flux = 0, biased = 0;
  double relative() const { return flux > 0 ? biased / flux : 0; }
  KernelBias& operator+=(const KernelBias& o) {
    flux += o.flux;
    biased += o.biased;
    return *this;
  }
};

/// Everything of LightMaps but the filter of directions and the place in the atlas. To `bias`, if any, that of adaptive kernels is added.
LightMaps resolve(const ResolveInput& input, const KernelOptions& kernel, KernelBias* bias = nullptr);

/// Flux-weighted estimated relative error of the irradiance: Σ area·σ / Σ area·E over all lit texels.
double estimatedRelativeError(const LightMaps& maps, const TexelLayout& layout);

/// The same of the maps that resolve() would make, but for rounding, without making them: in a fraction of the time, and
/// with ten bytes a texel. The same bits for the same tallies.
double estimateRelativeError(const ResolveInput& input, const KernelOptions& kernel);

}  // namespace lucarne
