#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/units.h"

namespace lucarne {
namespace {

/// `digits` digits in the shorter of plain and exponent form, no trailing zeros, whatever the locale.
std::string general(double value, int digits) {
  std::array<char, 64> buffer;
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return {buffer.data(), result.ptr};
}

struct Scaled {
  double value;
  std::size_t unit;
};

/// Divides by `step` until three digits show it; 999.6 already counts as the next unit's 1.
Scaled scaled(double value, double step, std::size_t units) {
  std::size_t unit = 0;
  while (value >= step * 0.9995 && unit + 1 < units) {
    value /= step;
    ++unit;
  }
  return {value, unit};
}

std::string withSuffix(double value) {
  constexpr std::array<const char*, 7> kSuffixes = {"", "k", "M", "G", "T", "P", "E"};
  const Scaled s = scaled(value, 1000, kSuffixes.size());
  return general(s.value, 3) + kSuffixes[s.unit];
}

std::string twoParts(std::uint64_t major, const char* majorUnit, std::uint64_t minor, const char* minorUnit) {
  std::string text = std::to_string(major) + " " + majorUnit;
  if (minor > 0) text += " " + std::to_string(minor) + " " + minorUnit;
  return text;
}

/// Rounded, within what a clock can show.
std::uint64_t wholeSeconds(double seconds) {
  constexpr double kMost = 1e15;
  return seconds > 0 ? static_cast<std::uint64_t>(std::min(seconds, kMost) + 0.5) : 0;
}

}  // namespace

std::string formatCount(std::uint64_t count) {
  return count < 10000 ? std::to_string(count) : withSuffix(static_cast<double>(count));
}

std::string formatExactCount(std::uint64_t count) {
  constexpr std::array<char, 4> kSuffixes = {'k', 'M', 'G', 'T'};
  std::string shortest = std::to_string(count);
  std::uint64_t unit = 1;
  for (const char suffix : kSuffixes) {
    unit *= 1000;
    if (count < unit) break;
    std::string fraction = std::to_string(unit + count % unit).substr(1);  // zeros in front kept
    fraction.erase(fraction.find_last_not_of('0') + 1);
    const std::string text = std::to_string(count / unit) + (fraction.empty() ? "" : "." + fraction) + suffix;
    if (text.size() < shortest.size()) shortest = text;
  }
  return shortest;
}

std::string formatBytes(std::uint64_t bytes) {
  constexpr std::array<const char*, 7> kUnits = {" B", " KiB", " MiB", " GiB", " TiB", " PiB", " EiB"};
  const Scaled s = scaled(static_cast<double>(bytes), 1024, kUnits.size());
  return general(s.value, s.value >= 1000 ? 4 : 3) + kUnits[s.unit];
}

std::string formatDuration(double seconds) {
  if (std::isnan(seconds)) return "unknown";
  if (seconds < 59.95) return general(std::max(seconds, 0.0), seconds < 1 ? 2 : 3) + " s";
  const std::uint64_t s = wholeSeconds(seconds);
  if (s < 3600) return twoParts(s / 60, "min", s % 60, "s");
  if (s < 86400) return twoParts(s / 3600, "h", s % 3600 / 60, "min");
  return twoParts(s / 86400, "d", s % 86400 / 3600, "h");
}

std::string formatClock(double seconds) {
  const std::uint64_t s = wholeSeconds(seconds);
  const auto padded = [](std::uint64_t value) {
    return std::string{static_cast<char>('0' + value / 10), static_cast<char>('0' + value % 10)};
  };
  if (s < 3600) return std::to_string(s / 60) + ":" + padded(s % 60);
  return std::to_string(s / 3600) + ":" + padded(s % 3600 / 60) + ":" + padded(s % 60);
}

std::string formatRate(double perSecond, std::string_view what) {
  return withSuffix(std::max(perSecond, 0.0)) + " " + std::string(what) + "/s";
}

std::string formatPercent(double fraction) {
  if (std::isnan(fraction)) return "unknown";
  return general(100 * fraction, fraction >= 0.995 ? 3 : 2) + " %";
}

std::string formatNumber(double value) { return general(value, 4); }

}  // namespace lucarne
