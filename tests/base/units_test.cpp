#include "base/units.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/base/expect_error.h"

namespace lucarne::units_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();

template <class Parse>
void expectRefused(Parse parse, std::initializer_list<const char*> texts) {
  for (const char* text : texts) {
    EXPECT_THAT(errorOf(ExitCode::usage, [&] { parse("--option", text); }),
                AllOf(HasSubstr("--option"), HasSubstr(text)))
        << text;
  }
}

TEST(ParseCount, IsExactUpToTheLargest) {
  const auto count = [](const char* text) { return parseCount("--photons", text); };
  EXPECT_EQ(count("0"), 0u);
  EXPECT_EQ(count("4096"), 4096u);
  EXPECT_EQ(count("20M"), 20'000'000u);
  EXPECT_EQ(count("2.5k"), 2500u);
  EXPECT_EQ(count("1e9"), 1'000'000'000u);
  EXPECT_EQ(count("1.5e+3"), 1500u);
  EXPECT_EQ(count("5000e-3"), 5u);
  EXPECT_EQ(count("1e3k"), 1'000'000u);
  EXPECT_EQ(count("3T"), 3'000'000'000'000u);
  EXPECT_EQ(count("0.000000"), 0u);
  EXPECT_EQ(count("00012"), 12u);
  EXPECT_EQ(count("1.0000000000000000000000000000"), 1u);
  EXPECT_EQ(count("9007199254740993"), 9007199254740993u);  // 2^53 + 1: not a double
  EXPECT_EQ(count("18446744073709551615"), kLargest);
  EXPECT_EQ(count("18446744.073709551615T"), kLargest);
}

TEST(ParseCount, RefusesEverythingElse) {
  expectRefused(parseCount, {"",        " 1",          "1 ",   "-1",  "+1",    "1.5",           "0.5k1",
                             "2.5001k", "1e",          "1e-1", "M",   ".",     "20MM",          "20Mi",
                             "20x",     "0x10",        "nan",  "inf", "1,000", "1e99999999999", "18446744073709551616",
                             "1e20",    "1e2000000000"});
}

TEST(ParseDuration, AddsItsUnits) {
  const auto seconds = [](const char* text) { return parseDuration("--time", text); };
  EXPECT_EQ(seconds("90s"), 90);
  EXPECT_EQ(seconds("5m"), 300);
  EXPECT_EQ(seconds("8h"), 28800);
  EXPECT_EQ(seconds("1h30m"), 5400);
  EXPECT_EQ(seconds("1d2h3m4.5s"), 93784.5);
  EXPECT_EQ(seconds("1.5h"), 5400);
  EXPECT_EQ(seconds("0s"), 0);
  expectRefused(parseDuration,
                {"", "8", "h", "1h30", "30m1h", "1h1h", "-5m", "5 m", "5min", "1e400s", "101000d", "nan s"});
}

TEST(ParseBytes, CountsInPowersOf1024) {
  const auto bytes = [](const char* text) { return parseBytes("--memory", text); };
  EXPECT_EQ(bytes("16G"), std::uint64_t{16} << 30);
  EXPECT_EQ(bytes("512M"), std::uint64_t{512} << 20);
  EXPECT_EQ(bytes("1.5G"), std::uint64_t{3} << 29);
  EXPECT_EQ(bytes("100"), 100u);
  EXPECT_EQ(bytes("8g"), bytes("8GiB"));
  EXPECT_EQ(bytes("8GB"), bytes("8G"));
  EXPECT_EQ(bytes("7B"), 7u);
  expectRefused(parseBytes, {"", "G", "-1G", "1X", "1GiBs", "1ib", "9000000P", "1e30", "1 G"});
}

TEST(ParsePercentage, TakesPercentAndFraction) {
  EXPECT_DOUBLE_EQ(parsePercentage("--target-error", "2%"), 0.02);
  EXPECT_DOUBLE_EQ(parsePercentage("--target-error", "0.02"), 0.02);
  EXPECT_EQ(parsePercentage("--target-error", "100%"), 1);
  EXPECT_EQ(parsePercentage("--target-error", "0"), 0);
  expectRefused(parsePercentage, {"", "%", "2", "101%", "-1%", "2%%", "2 %", "nan", "1e999"});
}

TEST(FormatCount, ShowsThreeDigits) {
  EXPECT_EQ(formatCount(0), "0");
  EXPECT_EQ(formatCount(9999), "9999");
  EXPECT_EQ(formatCount(20'000'000), "20M");
  EXPECT_EQ(formatCount(8'600'000), "8.6M");
  EXPECT_EQ(formatCount(1'234'567), "1.23M");
  EXPECT_EQ(formatCount(123'456), "123k");
  EXPECT_EQ(formatCount(999'949), "1M");
  EXPECT_EQ(formatCount(kLargest), "18.4E");
}

TEST(FormatBytes, UsesBinaryUnits) {
  EXPECT_EQ(formatBytes(0), "0 B");
  EXPECT_EQ(formatBytes(1000), "1000 B");
  EXPECT_EQ(formatBytes(1024), "1 KiB");
  EXPECT_EQ(formatBytes(std::uint64_t{3} << 29), "1.5 GiB");
  EXPECT_EQ(formatBytes((std::uint64_t{1} << 30) - 1), "1 GiB");
  EXPECT_EQ(formatBytes(std::uint64_t{1010} << 20), "1010 MiB");
}

TEST(FormatDuration, ReadsLikeSpeech) {
  EXPECT_EQ(formatDuration(0.345), "0.34 s");
  EXPECT_EQ(formatDuration(12.34), "12.3 s");
  EXPECT_EQ(formatDuration(59.99), "1 min");
  EXPECT_EQ(formatDuration(303), "5 min 3 s");
  EXPECT_EQ(formatDuration(3600), "1 h");
  EXPECT_EQ(formatDuration(29100), "8 h 5 min");
  EXPECT_EQ(formatDuration(183600), "2 d 3 h");
  EXPECT_EQ(formatDuration(-1), "0 s");
  EXPECT_EQ(formatDuration(std::nan("")), "unknown");
}

TEST(FormatClock, PadsAllButTheFirst) {
  EXPECT_EQ(formatClock(7.4), "0:07");
  EXPECT_EQ(formatClock(725), "12:05");
  EXPECT_EQ(formatClock(3723), "1:02:03");
  EXPECT_EQ(formatClock(-3), "0:00");
}

TEST(FormatOthers, AreShort) {
  EXPECT_EQ(formatRate(1'230'000, "photons"), "1.23M photons/s");
  EXPECT_EQ(formatRate(0, "rays"), "0 rays/s");
  EXPECT_EQ(formatPercent(0.0213), "2.1 %");
  EXPECT_EQ(formatPercent(1), "100 %");
  EXPECT_EQ(formatPercent(std::nan("")), "unknown");
  EXPECT_EQ(formatNumber(16), "16");
  EXPECT_EQ(formatNumber(0.125), "0.125");
  EXPECT_EQ(formatNumber(1.0 / 3), "0.3333");
}

}  // namespace
}  // namespace lucarne::units_test
