// How far a long run is: on a terminal one live line, in a log file a line a minute and a last one at the end, or JSON.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/progress_model.h"

namespace lucarne {

/// Where the lines go. Everything of the outside world that progress needs, so that tests can bring their own.
struct ProgressOutput {
  std::function<void(const std::string&)> write;
  std::function<double()> seconds;  // a clock that never goes back
  bool isTerminal = false;
  int columns = 0;    // of the terminal; 0: unknown
  bool json = false;  // one object a line, one a second
};

/// stderr and the steady clock; JSON to stdout.
ProgressOutput standardProgressOutput(bool json = false);

/// "baking [#####     ]  43 %  8.6M of 20M photons  1.23M photons/s  3.1M rays/s  error 1.4 %, 0.9 % at the end
/// 0:12 left  state in 4:51". On a narrow terminal the less important parts are left out. Nothing when quiet.
class ProgressLine {
 public:
  ProgressLine(std::string verb, ProgressGoal goal, bool quiet, ProgressOutput output = standardProgressOutput());
  /// Ends a live line, so that an error message starts on its own.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// What earlier runs did: counts as done, not in the rates. Before the first update.
  void startFrom(std::uint64_t photons, std::uint64_t rays) { model_.startFrom(photons, rays); }
  /// Done so far; `untilCheckpoint`: seconds, negative where none is to come. Cheap: writes at most 5 times a second on
  /// a terminal, once a minute in a log, once a second as JSON.
  void update(std::uint64_t photons, std::uint64_t rays, double untilCheckpoint = -1);
  /// Of what comes before the photons: samples of direct light.
  void updateGathering(std::uint64_t samples, std::uint64_t total);
  /// The error was estimated when so many photons were traced.
  void estimated(double error, std::uint64_t photons) { model_.estimated(error, photons); }
  /// The seconds up to now went into something that is not tracing and will not come again for long.
  void paused(double seconds) { model_.paused(output_.seconds() - seconds, output_.seconds()); }
  /// The last line, with the rates of the whole run. More calls do nothing.
  void finish();

 private:
  bool due(double now);
  std::string amount(double now) const;
  std::string liveText(double now) const;
  std::string lastText(double now) const;
  std::string jsonText(double now, const char* phase) const;
  std::string fitted(const std::vector<std::string>& parts, const std::vector<int>& order) const;
  void show(const std::string& text);
  void endLine();

  std::string verb_;
  bool quiet_;
  ProgressOutput output_;
  ProgressModel model_;
  double lastShown_;
  double untilCheckpoint_ = -1;
  std::size_t shownLength_ = 0;  // of the live line on the screen
  bool finished_ = false;
};

}  // namespace lucarne
