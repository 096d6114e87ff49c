// The state of a bake on disk, so that a killed one goes on: parts in OUT.checkpoint/, of which the last two are kept.
//
// A state is written aside, flushed and renamed, so at every moment the folder holds the newest whole state, or (for
// the moment before the older one is removed) three of them. Names count up: state-000007.part.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "distributed/part_file.h"

namespace lucarne {

class CheckpointFolder {
 public:
  /// Touches nothing.
  explicit CheckpointFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~CheckpointFolder();
  CheckpointFolder(const CheckpointFolder&) = delete;
  CheckpointFolder& operator=(const CheckpointFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  /// Makes the folder and holds it for this process; Error(failed) when another bake does. Removes what killed writers
  /// left aside.
  void open();

  /// The newest state whose tallies could be added to `tallies` (zero before), and its header. Damaged ones are named
  /// in a warning and passed over, and `tallies` cleared of them. A state for which `check` throws ends the search with
  /// that error.
  std::optional<PartHeader> load(Tallies& tallies,
                                 const std::function<void(const PartHeader&, const std::string& file)>& check);

  /// What load() would look at, newest first. Damaged headers are passed over.
  std::optional<PartHeader> peek() const;

  /// Writes the next state and removes all but it and the one before. A folder that vanished is made again. Where the
  /// disk is full, the older state makes room; the newest stays in any case.
  void save(const PartHeader& header, std::span<const std::uint8_t> scene, const Tallies& tallies);

  /// Makes room: all but the newest state go.
  void keepNewest() const { removeBut(1); }

  /// What all states take on disk.
  std::uint64_t bytes() const;

  /// The newest state becomes `target`, in one step.
  void publish(const std::filesystem::path& target);

  /// Removes the folder, if it holds nothing but states.
  void remove();

  /// Renames the folder to NAME.old, in place of one that is there, and returns that name. This one is closed then.
  std::filesystem::path moveAside();

 private:
  std::vector<std::filesystem::path> states() const;  // newest first
  void removeLeftovers() const;
  void removeBut(std::size_t kept) const;
  void write(const PartHeader& header, std::span<const std::uint8_t> scene, const Tallies& tallies) const;

  std::filesystem::path folder_;
  int lock_ = -1;
};

/// When the next checkpoint is due: after the interval, or later, so that saving takes no more than a fiftieth of the
/// time.
class CheckpointClock {
 public:
  using Clock = std::chrono::steady_clock;
  /// `interval` in seconds; 0: never.
  explicit CheckpointClock(double interval, Clock::time_point now = Clock::now())
      : interval_(interval), last_(now), next_(interval) {}
  bool due(Clock::time_point now = Clock::now()) const { return interval_ > 0 && secondsSince(now) >= next_; }
  void saved(double costSeconds, Clock::time_point now = Clock::now()) {
    last_ = now;
    next_ = std::max(interval_, kCostFactor * costSeconds);
  }
  /// Until the next one.
  double interval() const { return next_; }
  double untilDue(Clock::time_point now = Clock::now()) const {
    return interval_ > 0 ? std::max(0.0, next_ - secondsSince(now)) : -1;
  }

 private:
  static constexpr double kCostFactor = 50;
  double secondsSince(Clock::time_point now) const { return std::chrono::duration<double>(now - last_).count(); }
  double interval_;
  Clock::time_point last_;
  double next_;
};

}  // namespace lucarne
