#include "base/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/units.h"

namespace lucarne {
namespace {

constexpr double kTerminalInterval = 0.2, kLogInterval = 60, kJsonInterval = 1;  // seconds

std::string percentOf(double fraction) {
  const std::string percent = std::to_string(static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0)));
  return std::string(3 - std::min<std::size_t>(percent.size(), 3), ' ') + percent + " %";
}

std::string barOf(double fraction) {
  constexpr std::size_t kWidth = 20;
  const auto full = static_cast<std::size_t>(static_cast<double>(kWidth) * std::clamp(fraction, 0.0, 1.0));
  return "[" + std::string(full, '#') + std::string(kWidth - full, ' ') + "]";
}

nlohmann::json orNull(const std::optional<double>& value) {
  return value && *value >= 0 && *value < 1e300 ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace

ProgressOutput standardProgressOutput(bool json) {
  ProgressOutput output;
  output.json = json;
  output.write = [file = json ? stdout : stderr](const std::string& text) {
    std::fputs(text.c_str(), file);
    std::fflush(file);
  };
  output.seconds = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  output.isTerminal = !json && ::isatty(STDERR_FILENO) == 1;
  winsize size{};
  if (output.isTerminal && ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0) output.columns = size.ws_col;
  return output;
}

ProgressLine::ProgressLine(std::string verb, ProgressGoal goal, bool quiet, ProgressOutput output)
    : verb_(std::move(verb)),
      quiet_(quiet),
      output_(std::move(output)),
      model_(std::move(goal), output_.seconds()),
      lastShown_(output_.seconds()) {}

ProgressLine::~ProgressLine() { endLine(); }

bool ProgressLine::due(double now) {
  const double interval = output_.json ? kJsonInterval : output_.isTerminal ? kTerminalInterval : kLogInterval;
  if (now - lastShown_ < interval) return false;
  lastShown_ = now;
  return true;
}

void ProgressLine::update(std::uint64_t photons, std::uint64_t rays, double untilCheckpoint) {
  if (quiet_ || finished_) return;
  const double now = output_.seconds();
  model_.update(now, photons, rays);
  untilCheckpoint_ = untilCheckpoint;
  if (due(now)) show(output_.json ? jsonText(now, "tracing") : liveText(now));
}

void ProgressLine::updateGathering(std::uint64_t samples, std::uint64_t total) {
  if (quiet_ || finished_ || total == 0) return;
  const double now = output_.seconds(), fraction = static_cast<double>(samples) / static_cast<double>(total);
  if (!due(now)) return;
  if (output_.json) {
    const nlohmann::json object = {{"phase", "gathering"},
                                   {"seconds", model_.seconds(now)},
                                   {"samples", samples},
                                   {"total_samples", total},
                                   {"fraction", fraction}};
    show(object.dump());
  } else {
    show("gathering direct light " + percentOf(fraction) + "  " + formatCount(samples) + " of " + formatCount(total) +
         " samples");
  }
}

void ProgressLine::finish() {
  if (quiet_ || finished_) return;
  finished_ = true;
  const double now = output_.seconds();
  show(output_.json ? jsonText(now, "traced") : lastText(now));
  endLine();
}

std::string ProgressLine::amount(double now) const {
  std::string text;
  if (const std::optional<double> fraction = model_.fraction(now)) text = percentOf(*fraction) + "  ";
  text += formatCount(model_.photons());
  if (model_.goal().photons > 0) text += " of " + formatCount(model_.goal().photons);
  return text + " photons";
}

/// Parts are left out from the end of `order` until the line fits.
std::string ProgressLine::fitted(const std::vector<std::string>& parts, const std::vector<int>& order) const {
  for (std::size_t kept = order.size();; --kept) {
    std::string line;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto place = std::find(order.begin(), order.end(), static_cast<int>(i)) - order.begin();
      if (parts[i].empty() || place >= static_cast<std::ptrdiff_t>(kept)) continue;
      line += (line.empty() ? "" : i < 3 ? " " : "  ") + parts[i];
    }
    const bool fits = !output_.isTerminal || output_.columns <= 1 || line.size() < static_cast<std::size_t>(output_.columns);
    if (fits || kept <= 2) return line;
  }
}

std::string ProgressLine::liveText(double now) const {
  const std::optional<double> fraction = model_.fraction(now), left = model_.secondsLeft(now), error = model_.errorNow(),
                              errorAtEnd = model_.errorAtEnd(now);
  std::string errorText;
  if (error) errorText = "error " + formatPercent(*error);
  if (error && errorAtEnd) errorText += ", " + formatPercent(*errorAtEnd) + " at the end";
  const std::vector<std::string> parts = {
      verb_,
      output_.isTerminal && fraction ? barOf(*fraction) : "",
      amount(now),
      formatRate(model_.photonRate(), "photons"),
      formatRate(model_.rayRate(), "rays"),
      errorText,
      left ? formatClock(*left) + " left" : "",
      untilCheckpoint_ >= 0 ? "state in " + formatClock(untilCheckpoint_) : ""};
  return fitted(parts, {0, 2, 6, 5, 4, 1, 3, 7});
}

std::string ProgressLine::lastText(double now) const {
  std::string text = verb_ + " " + amount(now) + "  " + formatRate(model_.meanPhotonRate(now), "photons") + "  " +
                     formatRate(model_.meanRayRate(now), "rays");
  return text + "  " + formatDuration(model_.seconds(now));
}

std::string ProgressLine::jsonText(double now, const char* phase) const {
  const std::uint64_t goal = model_.goal().photons;
  const nlohmann::json object = {{"phase", phase},
                                 {"seconds", model_.seconds(now)},
                                 {"photons", model_.photons()},
                                 {"total_photons", goal > 0 ? nlohmann::json(goal) : nlohmann::json()},
                                 {"fraction", orNull(model_.fraction(now))},
                                 {"photons_per_second", model_.photonRate()},
                                 {"rays_per_second", model_.rayRate()},
                                 {"seconds_left", orNull(model_.secondsLeft(now))},
                                 {"estimated_relative_error", orNull(model_.errorNow())},
                                 {"expected_relative_error", orNull(model_.errorAtEnd(now))},
                                 {"seconds_to_checkpoint", orNull(untilCheckpoint_)}};
  return object.dump();
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
