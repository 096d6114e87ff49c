// Makes the maps of neighbouring charts agree along their seams (seams.h).
//
// Texels that lookups along a seam read are changed by Δ so that
//
//   Σ over places  w · (jump of the lookups across the seam)²  +  λ · Σ over texels Δ²
//
// is least (seam optimisation: Iwanicki, "Lighting technology of The Last of Us", 2013); w is the length of seam that a
// place stands for, in texels: ½, also where an edge is shorter. Irradiance is fitted first, then the light from each ψ
// that both sides have maps of; these are scaled so that they still sum to the irradiance, texel by texel. What one
// side of a seam gains the other loses, but for the difference in their texels' sizes: the change of flux is reported.
#pragma once

#include "dlm/seams.h"

namespace lucarne {

struct SeamReport {
  std::uint64_t seams = 0;
  double length = 0;  // metres
  // Root of the mean square of (E_a − E_b) over that of (E_a + E_b)/2, luminance, along all seams; and of the seam
  // where it is largest.
  double jumpBefore = 0, jumpAfter = 0;
  double worstBefore = 0, worstAfter = 0;
  double fluxChange = 0;  // of all light in the maps, relative
};

/// Measures the seams, and fits them if `fit`; else the maps stay as they are. `layout` gives the texels' areas.
SeamReport fitSeams(const SeamSet& seams, const TexelLayout& layout, LightMaps& maps, bool fit);

}  // namespace lucarne
