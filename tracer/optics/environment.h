// Light that comes from infinitely far: an equirectangular map as a light source.
//
// Directions: y is up, the top row of the map is +y, its centre column +x, and columns to the right turn from +x to +z:
//   column/width = atan2(z, x)/2π + 1/2,   row/height = θ/π with θ the angle from +y,
// the convention of three.js (equirectUv) and of Khronos' glTF Sample Viewer.
//
// The map is constant within a pixel. So sample(), pdf() and radiance() agree exactly, and the sums over pixels below
// are the integrals of the same function that is sampled (Pharr, Jakob and Humphreys 2023, "Physically Based
// Rendering", 12.5, without its filter). Integrals take a pixel's exact solid angle, 2π/width · (cos θ0 − cos θ1).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/image_file.h"
#include "base/vec.h"

namespace lucarne {

class Environment {
 public:
  /// Radiances in cd/m². A pixel with a value that is negative or not finite is stray: NaN and negative values become
  /// 0, +infinity the largest finite value of the map. InputError naming `name` for an image without pixels. The tables
  /// take 12 bytes a pixel; they have the same bits for any number of threads.
  Environment(ImageRgb image, std::string name);

  struct Sample {
    Vec3f direction;  // toward the sky, unit
    Rgb radiance;     // cd/m²
    double pdf;       // per steradian
  };

  /// Of directions toward the sky (away from the scene), unit; y up.
  Rgb radiance(Vec3f direction) const { return image_.pixels[pixelAt(direction)]; }
  /// In proportion to the mean of the radiance's channels. Columns grow with u, rows with v, both in [0, 1); the map
  /// must not be black. Radiance and pdf are those of the pixel that the direction lies in.
  Sample sample(double u, double v) const;
  /// Of sample(), per steradian; 0 everywhere for a black map.
  double pdf(Vec3f direction) const { return pdfOf(image_.pixels[pixelAt(direction)]); }

  bool isBlack() const { return !(total_ > 0); }
  /// ∫ L dω over the whole sphere, lx: the flux on a sphere per area of its cross-section.
  Rgbd scalarIrradiance() const { return scalarIrradiance_; }
  /// ∫ L dω / 4π, cd/m².
  Rgbd meanRadiance() const;
  /// Steradians of each pixel of a row.
  double pixelSolidAngle(int row) const;

  const ImageRgb& image() const { return image_; }
  const std::string& name() const { return name_; }
  std::size_t strayPixels() const { return strayPixels_; }
  /// Of the size and the pixels, strays replaced.
  Hash128 contentHash() const;

 private:
  void replaceStrays();
  void buildTables();
  std::size_t pixelAt(Vec3f direction) const;
  double pdfOf(Rgb radiance) const { return isBlack() ? 0 : mean(Rgbd(radiance)) / total_; }

  ImageRgb image_;
  std::string name_;
  std::size_t strayPixels_ = 0;
  std::vector<double> rows_, columns_;  // cumulative weights of the rows, and of the pixels within each row
  std::vector<std::uint32_t> rowGuide_, columnGuide_;
  std::vector<double> cosines_;  // cos θ of the borders between rows, height + 1
  double total_ = 0;             // ∫ mean(L) dω
  Rgbd scalarIrradiance_;
};

}  // namespace lucarne
