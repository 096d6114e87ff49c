// Keeps the rates of a running bake in the header that its states carry.
#pragma once

#include <chrono>

#include "distributed/part_header.h"

namespace lucarne {

class RateRecorder {
 public:
  /// Goes on where the curve in `header` ends; a bake that goes on without one has a curve from here on.
  explicit RateRecorder(PartHeader& header) : header_(header) {
    if (header.rates.points().empty()) header.rates.add({0, header.photons.count()});
    before_ = header.rates.points().back().milliseconds;
  }
  /// Photons done so far, those of earlier runs included.
  void add(std::uint64_t photons) {
    const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_).count();
    header_.rates.add({before_ + static_cast<std::uint64_t>(elapsed), photons});
  }

 private:
  using Clock = std::chrono::steady_clock;
  PartHeader& header_;
  std::uint64_t before_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace lucarne
