#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/units.h"

namespace lucarne {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, const std::string& reason) {
  throw UsageError(std::string(option) + " '" + std::string(text) + "': " + reason);
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// digits · 10^exponent, as it stands in the text, with leading and trailing zeros taken off the digits.
struct Decimal {
  std::string digits;
  long exponent = 0;
};

/// Takes `12`, `1.5`, `.5`, `1e9` off the front of `text`; no sign. Nothing when there is no number.
std::optional<Decimal> takeDecimal(std::string_view& text) {
  Decimal number;
  std::size_t at = 0, digits = 0;
  bool point = false;
  for (; at < text.size() && (isDigit(text[at]) || (text[at] == '.' && !point)); ++at) {
    if (text[at] == '.') {
      point = true;
      continue;
    }
    ++digits;
    number.digits += text[at];
    if (point) --number.exponent;
  }
  if (digits == 0) return std::nullopt;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t from = at + 1;
    if (from < text.size() && text[from] == '+') ++from;
    int exponent = 0;
    const auto result = std::from_chars(text.data() + from, text.data() + text.size(), exponent);
    if (result.ec != std::errc{}) return std::nullopt;
    number.exponent += exponent;
    at = static_cast<std::size_t>(result.ptr - text.data());
  }
  text.remove_prefix(at);
  while (number.digits.ends_with('0')) {
    number.digits.pop_back();
    ++number.exponent;
  }
  number.digits.erase(0, std::min(number.digits.find_first_not_of('0'), number.digits.size()));
  return number;
}

double toDouble(const Decimal& number) {
  const std::string text = (number.digits.empty() ? "0" : number.digits) + "e" + std::to_string(number.exponent);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range)
    return number.exponent > 0 ? std::numeric_limits<double>::infinity() : 0;
  return value;
}

/// Nothing when it does not fit; the exponent is not negative.
std::optional<std::uint64_t> toWhole(const Decimal& number) {
  constexpr long kMostDigits = 20;
  if (number.digits.empty()) return 0;
  if (static_cast<long>(number.digits.size()) + number.exponent > kMostDigits) return std::nullopt;
  std::uint64_t value = 0;
  const std::string all = number.digits + std::string(static_cast<std::size_t>(number.exponent), '0');
  const auto result = std::from_chars(all.data(), all.data() + all.size(), value);
  return result.ec == std::errc{} ? std::optional(value) : std::nullopt;
}

struct Unit {
  std::string_view name;
  double factor;
};

std::optional<double> factorOf(std::span<const Unit> units, std::string_view name) {
  const auto found = std::find_if(units.begin(), units.end(), [&](const Unit& unit) { return unit.name == name; });
  return found == units.end() ? std::nullopt : std::optional(found->factor);
}

}  // namespace

std::uint64_t parseCount(std::string_view option, std::string_view text) {
  constexpr std::string_view kExample = "write a whole number such as 4096, 20M or 1e9";
  std::string_view rest = text;
  std::optional<Decimal> number = takeDecimal(rest);
  if (!number || rest.size() > 1) refuse(option, text, "not a count; " + std::string(kExample));
  if (!rest.empty()) {
    constexpr std::string_view kSuffixes = "kMGT";
    const std::size_t power = rest[0] == 'K' ? 0 : kSuffixes.find(rest[0]);
    if (power == std::string_view::npos) refuse(option, text, "not a count; " + std::string(kExample));
    number->exponent += 3 * static_cast<long>(power + 1);
  }
  if (number->exponent < 0 && !number->digits.empty()) refuse(option, text, "not whole; " + std::string(kExample));
  const std::optional<std::uint64_t> value = toWhole(*number);
  if (!value) refuse(option, text, "too large; at most 18446744073709551615");
  return *value;
}

double parseDuration(std::string_view option, std::string_view text) {
  constexpr std::array<Unit, 4> kUnits = {{{"d", 86400}, {"h", 3600}, {"m", 60}, {"s", 1}}};
  constexpr double kLongest = 100 * 365.25 * 86400;
  const auto fail = [&](const char* reason) {
    refuse(option, text, std::string(reason) + "; write a duration such as 90s, 5m, 8h or 1h30m");
  };
  std::string_view rest = text;
  double seconds = 0, last = std::numeric_limits<double>::infinity();
  do {
    const std::optional<Decimal> number = takeDecimal(rest);
    if (!number) fail("not a duration");
    if (rest.empty()) fail("a unit is missing");
    const std::optional<double> factor = factorOf(kUnits, rest.substr(0, 1));
    if (!factor || *factor >= last) fail("not a duration");
    seconds += toDouble(*number) * *factor;
    last = *factor;
    rest.remove_prefix(1);
  } while (!rest.empty());
  if (!(seconds <= kLongest)) fail("more than a hundred years");
  return seconds;
}

std::uint64_t parseBytes(std::string_view option, std::string_view text) {
  constexpr std::array<Unit, 6> kUnits = {
      {{"", 1}, {"k", 0x1p10}, {"m", 0x1p20}, {"g", 0x1p30}, {"t", 0x1p40}, {"p", 0x1p50}}};
  std::string_view rest = text;
  const std::optional<Decimal> number = takeDecimal(rest);
  std::string unit(rest);
  std::transform(unit.begin(), unit.end(), unit.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (unit.ends_with("ib") && unit.size() == 3) unit.resize(1);
  if (unit.ends_with('b') && unit.size() <= 2) unit.pop_back();
  const std::optional<double> factor = factorOf(kUnits, unit);
  if (!number || !factor) refuse(option, text, "not an amount of memory; write for example 512M or 16G");
  const double bytes = toDouble(*number) * *factor;
  if (!(bytes < 0x1p63)) refuse(option, text, "too large");
  return static_cast<std::uint64_t>(bytes);
}

double parsePercentage(std::string_view option, std::string_view text) {
  std::string_view rest = text;
  const std::optional<Decimal> number = takeDecimal(rest);
  if (!number || (rest != "%" && !rest.empty())) refuse(option, text, "not a percentage; write for example 2% or 0.02");
  const double value = toDouble(*number) / (rest.empty() ? 1 : 100);
  if (!(value <= 1)) refuse(option, text, "more than 100 %; write for example 2% or 0.02");
  return value;
}

}  // namespace lucarne
