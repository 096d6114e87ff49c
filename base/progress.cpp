#include "base/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "base/math.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr double kTerminalInterval = 0.2, kLogInterval = 60;  // seconds
constexpr double kMemory = 15;                                // seconds after which a rate counts 1/e

double eventsPerSecond(std::uint64_t events, double seconds) {
  return seconds > 0 ? static_cast<double>(events) / seconds : 0;
}

}  // namespace

ProgressOutput standardProgressOutput() {
  ProgressOutput output;
  output.write = [](const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
  };
  output.seconds = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  output.isTerminal = ::isatty(STDERR_FILENO) == 1;
  winsize size{};
  if (output.isTerminal && ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0) output.columns = size.ws_col;
  return output;
}

ProgressLine::ProgressLine(std::string verb, std::uint64_t total, bool quiet, ProgressOutput output)
    : verb_(std::move(verb)), total_(total), quiet_(quiet), output_(std::move(output)) {
  start_ = lastUpdate_ = lastShown_ = output_.seconds();
}

ProgressLine::~ProgressLine() { endLine(); }

void ProgressLine::startFrom(std::uint64_t photons, std::uint64_t rays) {
  earlierPhotons_ = photons_ = photons;
  earlierRays_ = rays_ = rays;
}

void ProgressLine::update(std::uint64_t photons, std::uint64_t rays) {
  if (quiet_ || finished_) return;
  const double now = output_.seconds();
  const double elapsed = now - lastUpdate_;
  const double keep = exp(-elapsed / kMemory);
  photonRate_.add(static_cast<double>(photons - std::min(photons, photons_)), elapsed, keep);
  rayRate_.add(static_cast<double>(rays - std::min(rays, rays_)), elapsed, keep);
  photons_ = photons;
  rays_ = rays;
  lastUpdate_ = now;
  if (now - lastShown_ < (output_.isTerminal ? kTerminalInterval : kLogInterval)) return;
  lastShown_ = now;
  show(liveText());
}

void ProgressLine::finish() {
  if (quiet_ || finished_) return;
  finished_ = true;
  show(lastText(output_.seconds() - start_));
  endLine();
}

std::string ProgressLine::amount() const {
  if (total_ == 0) return formatCount(photons_) + " photons";
  const double share = static_cast<double>(photons_) / static_cast<double>(total_);
  const std::string percent = std::to_string(static_cast<int>(100 * std::min(share, 1.0)));
  return std::string(3 - std::min<std::size_t>(percent.size(), 3), ' ') + percent + " %  " + formatCount(photons_) +
         " of " + formatCount(total_) + " photons";
}

std::string ProgressLine::liveText() const {
  const double rate = photonRate_.perSecond();
  std::string text =
      verb_ + " " + amount() + "  " + formatRate(rate, "photons") + "  " + formatRate(rayRate_.perSecond(), "rays");
  if (total_ > photons_ && rate > 0)
    text += "  " + formatClock(static_cast<double>(total_ - photons_) / rate) + " left";
  return text;
}

std::string ProgressLine::lastText(double seconds) const {
  return verb_ + " " + amount() + "  " + formatRate(eventsPerSecond(photons_ - earlierPhotons_, seconds), "photons") + "  " +
         formatRate(eventsPerSecond(rays_ - earlierRays_, seconds), "rays") + "  " + formatDuration(seconds);
}

void ProgressLine::show(const std::string& text) {
  if (!output_.isTerminal) {
    output_.write(text + "\n");
    return;
  }
  // Cut to the terminal, because a line that wraps cannot be rewritten; padded over what stood there before.
  std::string line = text;
  if (output_.columns > 1) line.resize(std::min(line.size(), static_cast<std::size_t>(output_.columns) - 1));
  const std::size_t length = line.size();
  line.resize(std::max(length, shownLength_), ' ');
  output_.write("\r" + line);
  shownLength_ = length;
}

void ProgressLine::endLine() {
  if (shownLength_ == 0) return;
  output_.write("\n");
  shownLength_ = 0;
}

}  // namespace lucarne
