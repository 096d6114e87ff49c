// How far a long run is: on a terminal one live line, in a log file a line a minute, and a last line at the end.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace lucarne {

/// Where the lines go. Everything of the outside world that progress needs, so that tests can bring their own.
struct ProgressOutput {
  std::function<void(const std::string&)> write;
  std::function<double()> seconds;  // a clock that never goes back
  bool isTerminal = false;
  int columns = 0;  // of the terminal; 0: unknown
};

/// stderr and the steady clock.
ProgressOutput standardProgressOutput();

/// "baking  43 %  8.6M of 20M photons  1.23M photons/s  3.1M rays/s  0:12 left". Nothing at all when quiet.
class ProgressLine {
 public:
  /// `total` photons; 0 when it is not known, then neither percentage nor time left are shown.
  ProgressLine(std::string verb, std::uint64_t total, bool quiet, ProgressOutput output = standardProgressOutput());
  /// Ends a live line, so that an error message starts on its own.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// What earlier runs did: counts as done, not in the rates. Before the first update.
  void startFrom(std::uint64_t photons, std::uint64_t rays);
  /// Done so far. Cheap: writes at most 5 times a second on a terminal, once a minute elsewhere.
  void update(std::uint64_t photons, std::uint64_t rays);
  /// The last line, with the rates of the whole run. More calls do nothing.
  void finish();

 private:
  /// Events a second, older ones counting less and less.
  struct SmoothRate {
    double events = 0, seconds = 0;
    void add(double newEvents, double newSeconds, double keep) {
      events = events * keep + newEvents;
      seconds = seconds * keep + newSeconds;
    }
    double perSecond() const { return seconds > 0 ? events / seconds : 0; }
  };

  std::string amount() const;
  std::string liveText() const;
  std::string lastText(double seconds) const;
  void show(const std::string& text);
  void endLine();

  std::string verb_;
  std::uint64_t total_;
  bool quiet_;
  ProgressOutput output_;
  double start_ = 0, lastUpdate_ = 0, lastShown_ = 0;
  std::uint64_t photons_ = 0, rays_ = 0;
  std::uint64_t earlierPhotons_ = 0, earlierRays_ = 0;
  SmoothRate photonRate_, rayRate_;
  std::size_t shownLength_ = 0;  // of the live line on the screen
  bool finished_ = false;
};

}  // namespace lucarne
