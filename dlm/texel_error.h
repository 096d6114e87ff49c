// The standard error of each texel.
//
// m2 of the statistics gives the variance of a sum of independent photons, Var(Σx) ≈ Σx², filtered with the squares of
// the kernel's weights. Two things it cannot see: photons of low-discrepancy points vary less, and the photons of one
// path that fall into several texels under one kernel vary together. Both show in how far the two halves of the
// photons, those of even and those of odd index, differ: the sampler scrambles them apart, so for sums A and B of the
// halves, E[(A − B)²] = Var(A) + Var(B) = Var(A + B). Of one texel that is a single draw; its ratio to the variance
// of independent photons, averaged over the texels of a chart side that have about as many photons, says by how much to
// correct them all (replicates pooled by chart; Owen 1997, "Monte Carlo variance of scrambled net quadrature"). What
// low-discrepancy points gain grows with their number: hence the classes.
//
// Texels with few photons do not know their own m2: none says nothing at all. They lean on what their neighbourhood
// says, the more so the fewer they have.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lucarne {

/// Sums over texels, whose ratio is variance over that of independent photons.
struct ErrorRatio {
  double squares = 0;  // Σ (A − B)² / variance of independent photons
  double texels = 0;   // terms, in texels as independent of each other as their kernels allow
  ErrorRatio& operator+=(const ErrorRatio& o) {
    squares += o.squares;
    texels += o.texels;
    return *this;
  }
};

/// Fewer photons under a texel's kernel do not tell their spread.
inline constexpr double kEnoughPhotons = 12;

/// By class of photons under the kernel: up to 4 · kEnoughPhotons, up to 16 times as many, and so on.
class ErrorRatios {
 public:
  static std::uint8_t classOf(double photons);
  ErrorRatios& operator+=(const ErrorRatios& o);
  ErrorRatio total() const;
  ErrorRatio& operator[](std::size_t c) { return classes_[c]; }
  const ErrorRatio& operator[](std::size_t c) const { return classes_[c]; }

 private:
  std::array<ErrorRatio, 6> classes_;
};

/// What the texels of a class say of their ratio, as far as they can: where they say little it is that of the whole
/// `side`, as the class differs from others on `all` sides; a side that says little is as all are; and theirs, where
/// they say little, is 1.
double errorRatio(const ErrorRatios& side, const ErrorRatios& all, std::size_t photonClass);

/// Of texels in which at least kEnoughPhotons lie under the kernel; elsewhere the variance is itself too noisy to
/// divide by. `differences`: A − B; `variances`: of independent photons, the unit of differences squared; `photons`: under
/// the kernel; `overlap`: texels that share their photons, Σ k² / (Σ k)² of the kernel, inverse.
ErrorRatios measureErrorRatios(std::span<const double> differences, std::span<const double> variances,
                               std::span<const double> photons, double overlap);

/// Of a rectangle of texels: what its neighbourhood says a texel's Σx² is.
///
/// Windows about the texel grow until kEnoughPhotons have fallen into one, or all of the rectangle is in. Inside, Σx² is taken to be spread
/// evenly over the surface.
class NeighbourSquares {
 public:
  /// All of width × height texels: photons and Σx² that fell in, and surface inside.
  NeighbourSquares(int width, int height, std::span<const double> photons, std::span<const double> squares,
                   std::span<const double> area);
  /// Σx² for each unit of area around texel (x, y); 0 where no photon fell into the rectangle.
  double density(int x, int y, int smallestRadius) const;

 private:
  struct Sums {
    double photons = 0, squares = 0, area = 0;  // area in areaUnit_
  };
  Sums window(int x, int y, int radius) const;

  int width_, height_;
  double areaUnit_ = 1;
  std::vector<Sums> table_;  // over all texels above and left of a corner
};

/// Share of the neighbourhood in a texel's Σx², `photons` of which lie under its kernel: 1 for none, ½ for 3, 1/12 for
/// 10.
constexpr double neighbourShare(double photons) { return 1 / (1 + photons * photons / 9); }

}  // namespace lucarne
