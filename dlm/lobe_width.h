// How narrow a highlight a set of directions can show.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/light_maps.h"
#include "tracer/scene/scene.h"

namespace lucarne {

// A reflection lobe and a cell of Ω are both taken as Gaussians on the sphere, exp(λ(cos − 1)). Averaging the lobe over
// the cell is a convolution, which adds the variances 1/λ:
//
//   1/λ = 1/λ_lobe + 1/λ_cell
//
// λ_lobe: a reflection-Phong lobe cosⁿ and exp(λ(cos − 1)) enclose the same for λ = n + 1, as 2π/(n + 1) and 2π/λ; n
// comes from α (phong.h), so λ_lobe = (1/α² + 1)/2.
// λ_cell: for a cap of solid angle Ω_c the mean of 1 − cos is Ω_c/4π, for the Gaussian 1/λ: λ_cell = 4π/Ω_c = |Ω|.
// Against the true average of cosⁿ over Voronoi cells (|Ω| 14 … 256, n 1 … 1000, mirror direction up to 75° off the
// normal; half the summed difference of the normalised C·w) λ_lobe = n + 1 beats n and n + 2 for n = 1 and equals them
// elsewhere, and 1.2·|Ω| is the best λ_cell for small sets and as good for large ones: 2 % to 5 % in most cases, at
// worst 11 % (n = 1000, |Ω| ≤ 32). One λ_cell serves all cells, also those that the horizon cuts: a sliver must not
// have a say of its own.

//
// Where light is shared among three ψ (direction_filter.h) that sharing blurs by itself: light from ω is shown with
// Σ λ_k(ω) w(ψ_k), the lobe interpolated among ψ. Light counted by cells is shown with the w of a mean direction wherever
// in the cell it came from, which blurs by the cell's variance V = 1/λ_cell once more, in all 1/λ_lobe + 2V. The variance of a
// tent is 9/5 of that of a cell (a²/4 and 5a²/36 for a triangular grid with edges a), so that lobes of
//
//   1/λ = 1/λ_lobe + V/5
//
// are blurred as much in all, and there is no step at a cell's edge any more. With less, single tents show one by one; with
// more, broad lobes, which need none, are blurred for nothing.

/// λ_cell of |Ω| directions; of shared light the λ that takes its place, 5 times as sharp.
float cellSharpness(int directionCount, DirectionFilter filter = DirectionFilter::nearest);
/// Of light maps as they are shown.
float lightSharpness(const LightMaps& maps);
/// λ for GGX α and |Ω|.
float lobeSharpness(float alpha, int directionCount, DirectionFilter filter = DirectionFilter::nearest);
/// λ_lobe.
float coatSharpness(float alpha);

// Where the mean direction m of a cell's light is known (mean_direction.h), the light itself takes the cell's place: a
// Gaussian around m/|m|, whose sharpness κ follows from |m|. On the sphere (Banerjee, Dhillon, Ghosh and Sra, "Clustering on
// the unit hypersphere using von Mises-Fisher distributions", 2005):
//
//   κ = |m| (3 − |m|²)/(1 − |m|²)
//
// Light of several lamps in one cell has a mean that lies between them, and a kernel's few photons look like a point more
// often than they are one, so that what is shown is never sharper than kMeanBound cells:
//
//   1/κ_shown = 1/(kMeanBound·λ_cell) + (1 − 1/kMeanBound)/κ
//
// which for light that fills the cell is about λ_cell again.
inline constexpr float kMeanBound = 4;
/// κ_shown of light with |m| = `length`.
float meanSharpness(float length, int directionCount);

/// A material whose lobe is narrower than a cell: it is shown as wide as lobe and cell together, its energy kept.
struct WidenedHighlight {
  std::uint32_t material = 0;
  double exponent = 0;       // reflection-Phong, as the material asks
  double shownExponent = 0;  // as the player shows it, where there are mean directions that of light from a point
  bool textured = false;     // the roughness is that times a texture: narrower still in places
};

/// Of the materials that have light maps by direction, by index.
std::vector<WidenedHighlight> widenedHighlights(const Scene& scene, const LightMaps& maps);

}  // namespace lucarne
