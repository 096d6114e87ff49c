// What a light map holds at a texel, by paths that start there instead of photons that end there: the truth that maps
// are tested against.
//
//   value(t) = Σ k(t,t')·∫_t' E·α dA / Σ k(t,t')·open area(t')
//
// the same functional as resolve.h, with the same areas and contacts: places are drawn from the surface inside the texels t' that
// the kernel reaches, in proportion to k, and light that falls there is gathered by the path tracer. Map and gather
// have the same expectation, however coarse the texels are.
#pragma once

#include <array>
#include <vector>

#include "dlm/charts.h"
#include "dlm/deposit.h"
#include "dlm/kernel.h"
#include "dlm/tally.h"
#include "dlm/texel_contacts.h"
#include "tracer/transport/path_tracer.h"

namespace lucarne {

struct GatherScene {
  const PhotonScene& scene;
  const ChartSet& charts;
  const TexelLayout& layout;
  const TallyLayout& tallies;
  const DirectionSet& directions;
  std::span<const SideContacts> contacts = {};  // by side, as for resolve(); empty: as if there were none
};

/// Mean and standard error of luminance, lx.
struct GatherValue {
  double mean = 0, standardError = 0;
};

struct TexelGatherResult {
  bool covered = false;              // false: the kernel finds no surface, the map copies a neighbour
  Rgbd irradiance{};                // lx
  GatherValue luminance;            // of the irradiance
  std::vector<GatherValue> byRank;  // of each map of the side, in the order of its member set
};

/// `samples` paths at texel (x, y) of a side, numbered from 0 under `seed`.
TexelGatherResult gatherTexel(const GatherScene& scene, std::uint32_t side, int x, int y, const KernelOptions& kernel,
                              LightPart part, std::uint64_t samples, std::uint64_t seed);

}  // namespace lucarne
