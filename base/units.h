// Amounts as people type and read them. Parsers throw UsageError with the option and the text in it; `option` is as
// typed,
// "--photons".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lucarne {

/// "20M", "1e9", "4096", "2.5k" (k, M, G, T are powers of 1000), exactly. Whole, 0 … 2^64 − 1.
std::uint64_t parseCount(std::string_view option, std::string_view text);
/// Seconds of "8h", "5m", "90s", "1h30m", "2d", "1.5h"; a number without a unit is refused.
double parseDuration(std::string_view option, std::string_view text);
/// Bytes of "16G", "512M", "1.5G", "100": powers of 1024, with or without "B" or "iB".
std::uint64_t parseBytes(std::string_view option, std::string_view text);
/// Fraction of "2%" or "0.02", 0 … 1.
double parsePercentage(std::string_view option, std::string_view text);

/// "9999", "20M", "1.23M": three digits from ten thousand on.
std::string formatCount(std::uint64_t count);
/// The shortest text that parseCount() reads as the same number: "20M", "2.5M", "1234567".
std::string formatExactCount(std::uint64_t count);
/// "512 B", "1.5 GiB".
std::string formatBytes(std::uint64_t bytes);
/// "0.35 s", "12.3 s", "5 min 3 s", "8 h 5 min", "2 d 3 h".
std::string formatDuration(double seconds);
/// "0:07", "1:02:03".
std::string formatClock(double seconds);
/// "1.23M photons/s".
std::string formatRate(double perSecond, std::string_view what);
/// "2.1 %" of 0.021, two digits; "unknown" of NaN.
std::string formatPercent(double fraction);
/// Up to four digits, "16", "0.125", "1.234e-07".
std::string formatNumber(double value);

}  // namespace lucarne
