// The difference of two sets of light maps, gathered texel by texel or point by point.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/difference.h"
#include "dlm/dlm_reader.h"

namespace lucarne {

/// What both maps say of one place.
struct MapSample {
  double area = 0;          // m² that it stands for
  std::uint32_t chart = 0;  // of A
  bool back = false;
  Rgbd a{}, b{};                  // irradiance, lx
  double errorA = 0, errorB = 0;  // estimated relative standard errors of their luminance
};

/// The sample where the two differ most.
struct WorstPlace {
  MapSample sample;
  std::uint64_t texel = 0;  // of its chart, row by row (texel by texel only)
  Vec3d position{};         // metres
};

class MapDifference {
 public:
  MapDifference(const Dlm& a, const Dlm& b);

  /// True when the sample differs more than all before it: the caller then tells `worst` where it is.
  bool add(const MapSample& sample);
  /// Irradiance from the cell of ψ; only where both sets of directions are the same.
  void addDirection(int psi, double area, Rgbd a, Rgbd b) {
    directions[static_cast<std::size_t>(psi)].add(area, a, b);
    directional.add(area, a, b);
  }
  bool sameDirections() const { return !directions.empty(); }
  /// RMS of the differences of luminance over that which the estimated errors of two bakes that share no photons let
  /// expect: about 1 for noise alone. Empty where the maps tell no errors.
  std::optional<double> timesExpectedNoise() const;

  DifferenceSum irradiance, directional;
  std::vector<DifferenceSum> charts, directions;  // by ψ; empty: the sets differ
  WorstPlace worst;
  std::uint64_t samples = 0, withoutCounterpart = 0;

 private:
  double largest_ = -1, squares_ = 0, expected_ = 0;
};

/// Texel by texel: both have the same layout.
void compareTexels(const Dlm& a, const Dlm& b, MapDifference& difference);
/// At points spread evenly over A's surfaces, each of B's sides asked where A's is.
void comparePoints(const Dlm& a, const Dlm& b, std::uint64_t points, MapDifference& difference);

}  // namespace lucarne
