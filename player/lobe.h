// How light maps become radiance toward the eye: the reference that the shaders follow, for tests and for tools.
//
// Exact radiance is Lo = Le + ∫ f(wi, wo)·Li·cos dwi. The maps hold B_ψ = ∫_cell Li·cos dwi for each cell of the side,
// and E = Σ B_ψ. With the BSDF of bsdf.h, c the albedo of its base and ρ = ρ₁ + ρ_m that of its coat, after one bounce
// among its facets and after more (coat.h):
//
//   Lo = Le + (c·(1 − max ρ(wo)) + ρ_m(wo))/π · E + ρ₁(wo) · (Σ B_ψ w_ψ) / (Σ C_ψ w_ψ)
//
// Base: f = c/π·(1 − r(wi))(1 − r(wo))/(1 − r̄) with the part that depends on wi replaced by its mean over the
// hemisphere, ∫(1 − r(wi))·cos dwi/π = 1 − r̄. Exact for constant light.
//
// Coat: a weighted mean of the cells' mean radiance, times the albedo. C_ψ = ∫_cell cos dwi, over the part of the cell
// above the horizon, is what constant radiance 1 would have stored. So constant light L gives exactly L·ρ, whatever the
// weights are. Empty maps are members too: they count in the denominator.
//
// w_ψ is the reflection lobe averaged over the cell. Both are taken as Gaussians on the sphere, exp(λ(cos − 1)): the
// lobe around the mirror direction r, the cell around its mean direction d_ψ. Averaging is a convolution, which adds
// the variances 1/λ:
//
//   w_ψ = exp(λ(r·d_ψ − 1)),   1/λ = 1/λ_lobe + 1/λ_cell
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
// A lobe narrower than a cell is so widened to the cell, with its energy kept by the division.
#pragma once

#include <span>

#include "base/vec.h"
#include "tracer/optics/bsdf.h"

namespace lucarne {

/// One member of a side's directions, clipped by the horizon.
struct LobeCell {
  Vec3f direction{};      // mean light direction, unit
  float cosIntegral = 0;  // C, sr
};

/// λ_cell of |Ω| directions.
float cellSharpness(int directionCount);
/// λ for GGX α and |Ω|.
float lobeSharpness(float alpha, int directionCount);
/// exp(λ(cos − 1)), bounded below so that weights that are all far from the mirror direction become equal, not zero.
float lobeWeight(float sharpness, float cosine);
/// Mirror of `toEye` about the shading normal; both unit. Kept above the horizon.
Vec3f mirrorDirection(Vec3f normal, Vec3f toEye);

/// What one place of a side shows; all unit vectors on the visible side.
struct LobeView {
  Vec3f normal, toEye;
  int directionCount = 1;  // |Ω|
};

/// (Σ B w) / (Σ C w), cd/m²; E/π where `cells` is empty. `values`: B of the cells, lx, in the same order.
Rgb mirroredRadiance(const LobeView& view, float alpha, std::span<const LobeCell> cells, std::span<const Rgb> values,
                     Rgb E);
/// Lo without emission, cd/m².
Rgb reflectedRadiance(const LobeView& view, const Bsdf& bsdf, std::span<const LobeCell> cells,
                      std::span<const Rgb> values, Rgb E);

}  // namespace lucarne
