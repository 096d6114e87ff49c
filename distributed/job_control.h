// What ends a bake, and what the outside may ask of one that runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace lucarne {

/// What the outside asks. The functions are called often, the first from several threads at once.
struct JobControl {
  /// True from when the job is to end, with all that was done in its state.
  std::function<bool()> stop = [] { return false; };
  /// True once for every time that a preview was asked for.
  std::function<bool()> takePreview = [] { return false; };
  /// From here on nothing would be lost if a signal ended the process at once, with this line; empty: something would.
  std::function<void(const std::string& line)> mayEndAtOnce = [](const std::string&) {};
};

/// Why a job ended. All but `interrupted` are ends of a bake whose maps are to be made.
enum class JobEnd : std::uint8_t { photons, time, targetError, talliesFull, interrupted };

/// "photons", "time", "target_error", "tallies_full", "interrupted".
const char* nameOf(JobEnd end);

/// What ends a job before its photons do.
///
/// The error is judged only at counts of photons that are the same for every bake: 181/128 · 2^k and 2^k, each about √2
/// times the one before, from `firstJudged` on. So a bake ends at the same photon whatever its threads, ranks and
/// interruptions, and luck of the first few photons does not end it.
struct StopRules {
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();  // max: none
  double targetError = 0;                              // estimated relative error; 0: not judged
  std::uint64_t firstJudged = std::uint64_t{1} << 20;  // a power of two

  /// The first count after `photons` at which the error is judged.
  std::uint64_t nextJudged(std::uint64_t photons) const;
  /// True for such a count.
  bool isJudged(std::uint64_t photons) const;
};

/// No time is so short that a bake ends with fewer photons.
inline constexpr std::uint64_t kFewestPhotons = std::uint64_t{1} << 17;

}  // namespace lucarne
