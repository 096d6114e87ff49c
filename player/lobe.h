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
// w_ψ is the reflection lobe averaged over the cell, both taken as Gaussians on the sphere: the lobe around the mirror
// direction r, the cell around its mean direction d_ψ (dlm/lobe_width.h tells λ):
//
//   w_ψ = exp(λ(r·d_ψ − 1))
//
// A lobe narrower than a cell is so widened to the cell, with its energy kept by the division.
//
// Where the maps have mean directions m_ψ (dlm/mean_direction.h), the light of a cell is a Gaussian of its own, and so is that
// which constant radiance would have brought, with the mean m̄_ψ = ∫_cell ω cos dω / C_ψ. Each is convolved with the lobe:
//
//   (Σ B_ψ g(m_ψ)) / (Σ C_ψ g(m̄_ψ)),   g(m) = λ/(1 − exp(−2λ))·exp(λ(r·m/|m| − 1)),   1/λ = 1/λ_lobe + 1/κ_shown(|m|)
//
// g times 1/2π is a density over directions, so that sharp and wide light count by their energy. Constant light has
// m_ψ = m̄_ψ and stays exactly constant, whatever κ_shown makes of their lengths.
//
// Two other ways are there to be compared with it. Both take the lobe for a density over directions,
// D = (n + 1)/2π·cosⁿ, and the light of a cell for a lamp of perpendicular irradiance B_ψ/(n·d_ψ), and do not
// normalise:
//
//   Σ B_ψ D_ψ / (n·d_ψ)
//
// `sample` takes D at d_ψ alone. `barsi` averages it over the cell by a closed form, as Barsi, Szirmay-Kalos and Szécsi
// (2005) do for the Voronoi cells of an environment map: the cell is a cap of its solid angle 4π/|Ω| around d_ψ, in
// which cosines with r run from c₀ to c₁, and cosⁿ averaged evenly over them is (c₁ⁿ⁺¹ − c₀ⁿ⁺¹)/((n + 1)(c₁ − c₀)):
// exact for r = d_ψ and for small cells.
#pragma once

#include <span>

#include "base/vec.h"
#include "dlm/lobe_width.h"
#include "player/render_options.h"
#include "tracer/optics/bsdf.h"

namespace lucarne {

/// One member of a side's directions, clipped by the horizon.
struct LobeCell {
  Vec3f direction{};      // mean light direction, unit
  float cosIntegral = 0;  // C, sr
};

/// The same as lobeCell() of cell_tables.h gives it, but with m̄ in place of the direction.
using MeanCell = LobeCell;

/// exp(λ(cos − 1)), bounded below so that weights that are all far from the mirror direction become equal, not zero.
float lobeWeight(float sharpness, float cosine);
/// g of a mean direction for a lobe of sharpness λ_lobe around unit `r`.
float meanWeight(float lobe, Vec3f r, Vec3f mean, int directionCount);
/// Cosine of the radius of a cap that is one |Ω|-th of the sphere.
float capCosine(int directionCount);
/// D of an exponent at, or averaged over a cap around, a direction whose cosine with r is `cosine`; per sr.
float phongDensity(float exponent, float cosine);
float phongDensityOverCap(float exponent, float cosine, float capCosine);
/// Mirror of `toEye` about the shading normal; both unit. Kept above the horizon.
Vec3f mirrorDirection(Vec3f normal, Vec3f toEye);

/// What one place of a side shows; all unit vectors on the visible side.
struct LobeView {
  Vec3f normal, toEye;
  int directionCount = 1;  // |Ω|
  LobeKind lobe = LobeKind::cell;
  DirectionFilter filter = DirectionFilter::nearest;  // of the light maps
};

/// (Σ B w) / (Σ C w), or Σ B D/(n·d), cd/m²; E/π where `cells` is empty. `values`: B of the cells, lx, in the same
/// order.
Rgb mirroredRadiance(const LobeView& view, float alpha, std::span<const LobeCell> cells, std::span<const Rgb> values,
                     Rgb E);
/// (Σ B g(m)) / (Σ C g(m̄)), cd/m², by `cell` whatever the view says; `means`: m of the cells, in the same order.
Rgb mirroredRadiance(const LobeView& view, float alpha, std::span<const MeanCell> cells, std::span<const Rgb> values,
                     std::span<const Vec3f> means, Rgb E);
/// Lo without emission, cd/m².
Rgb reflectedRadiance(const LobeView& view, const Bsdf& bsdf, std::span<const LobeCell> cells,
                      std::span<const Rgb> values, Rgb E);
Rgb reflectedRadiance(const LobeView& view, const Bsdf& bsdf, std::span<const MeanCell> cells,
                      std::span<const Rgb> values, std::span<const Vec3f> means, Rgb E);

}  // namespace lucarne
