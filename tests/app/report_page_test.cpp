// The page of a report: a hostile scene stays text, and the page needs nothing but itself.
#include "app/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "app/html.h"
#include "app/rate_picture.h"
#include "app/report_files.h"

namespace lucarne::report_page_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kAttack = "</title></pre><script>alert(1)</script><img src=x onerror=\"a\" 'b'>&amp;\x01\xff";

/// A report in which every text is `text`, every number a number.
json reportOf(const std::string& text) {
  const json rgb = {1.5, 2.5, 3.5};
  json report = {{"scene", text},
                 {"program", text},
                 {"builds", {text}},
                 {"ray_caster", text},
                 {"command", text},
                 {"content_hash", text},
                 {"photons", 1'000'000},
                 {"seconds", 12.5},
                 {"photons_per_second", 80'000.0},
                 {"rays", 3'000'000},
                 {"rays_per_second", 240'000.0},
                 {"estimated_relative_error", 0.012},
                 {"ledger_balances", true},
                 {"expected_absorbed_lm", rgb},
                 {"absorbed_standard_error_lm", 0.5},
                 {"incident_lm", rgb},
                 {"checkpoints", 3},
                 {"threads", 2},
                 {"ranks", 1}};
  for (const char* term : {"emitted", "absorbed", "escaped", "cut_off", "roulette", "shading_normal"})
    report["flux_lm"][term] = rgb;
  report["warnings"] = {{{"id", text}, {"text", text}}};
  report["lights"] = {
      {{"name", text}, {"kind", text}, {"unit", text}, {"intensity", rgb}, {"luminous_flux_lm", 12.0}, {"share", 1.0}}};
  report["left_out"] = {text};
  report["uv1_refused"] = {text};
  report["widened_highlights"] = {{{"material", text}}};
  report["settings"] = {{text, text}};
  report["host"] = {{"cpu", text}, {"system", text}, {"threads", 2}, {"memory_bytes", 1 << 30}};
  report["trace_variant"] = {{"name", text}};
  report["seams"] = {{"mode", text}, {"count", 3}, {"rms_jump", 0.1}};
  report["rate_curve"] = {{"seconds", {0, 1, 2}}, {"photons", {0, 1000, 3000}}};
  return report;
}

ReportPictures picturesOf(const std::string& text) {
  const PagePicture picture{text, text, 2, 1, {1, 2, 3, 4}};
  return {{picture}, {picture}, {text}};
}

/// Tags of a page, without what stands in them beside the name.
std::map<std::string, int> tagsOf(const std::string& page) {
  std::map<std::string, int> tags;
  static const std::regex kTag("<([a-zA-Z/!]+)");
  for (auto at = std::sregex_iterator(page.begin(), page.end(), kTag); at != std::sregex_iterator(); ++at)
    ++tags[(*at)[1]];
  return tags;
}

TEST(ReportPage, OfAHostileSceneHasTheVeryMarkupOfAHarmlessOne) {
  const std::string harmless = reportPage(reportOf("room"), picturesOf("room"));
  const std::string hostile = reportPage(reportOf(kAttack), picturesOf(kAttack));
  EXPECT_EQ(tagsOf(hostile), tagsOf(harmless));
  EXPECT_THAT(hostile, Not(HasSubstr("<script")));
  EXPECT_THAT(hostile, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_EQ(std::count(hostile.begin(), hostile.end(), '"') - std::count(harmless.begin(), harmless.end(), '"'), 0)
      << "no attribute is ended early";
  EXPECT_EQ(hostile.find('\x01'), std::string::npos);
  EXPECT_EQ(hostile.find('\xff'), std::string::npos);
}

TEST(ReportPage, AsksForNothingElse) {
  const std::string page = reportPage(reportOf("room"), picturesOf("room"));
  for (const char* what : {"http:", "https:", "<script", "<link", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(what)));
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,AQIDBA==\""));
  EXPECT_THAT(page, HasSubstr("width=device-width"));
}

TEST(ReportPage, SaysWhatHappened) {
  const std::string page = reportPage(reportOf("room"), picturesOf("room"));
  for (const char* what : {"1M photons", "12.5 s", "1.2 %", "absorbed by surfaces", "add up exactly", "<svg", "room",
                           "lumens", "3.5", "1 GiB"})
    EXPECT_THAT(page, HasSubstr(what));
}

TEST(ReportPage, OfAReportThatLacksMembersIsAPageAllTheSame) {
  const std::string page = reportPage(json::object(), {});
  EXPECT_THAT(page, HasSubstr("</html>"));
  const json whole = reportOf("room");
  for (const auto& [key, value] : whole.items()) {
    json lacking = whole;
    lacking[key] = nullptr;
    EXPECT_THAT(reportPage(lacking, {}), HasSubstr("</html>")) << key;
  }
}

TEST(Html, TextComesBackAsItWas) {
  EXPECT_EQ(escapeHtml("a<b>&\"'\n\tπ"), "a&lt;b&gt;&amp;&quot;&#39;\n\tπ");
  EXPECT_EQ(escapeHtml(std::string("\0\x7f\xc3", 3)), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(Html, DataUrisAreThoseOfTheStandard) {
  const auto uri = [](const std::string& text) {
    return dataUri("text/plain", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(uri(""), "data:text/plain;base64,");  // RFC 4648, section 10
  EXPECT_EQ(uri("f"), "data:text/plain;base64,Zg==");
  EXPECT_EQ(uri("fo"), "data:text/plain;base64,Zm8=");
  EXPECT_EQ(uri("foo"), "data:text/plain;base64,Zm9v");
  EXPECT_EQ(uri("foobar"), "data:text/plain;base64,Zm9vYmFy");
  EXPECT_EQ(uri("\xff\xfe\xfd"), "data:text/plain;base64,//79");
}

TEST(RatePicture, DrawsTheHighestRateAtTheTop) {
  const std::string svg = ratePicture({{"seconds", {0, 10, 20}}, {"photons", {0, 20'000'000, 30'000'000}}});
  EXPECT_THAT(svg, HasSubstr("2M photons/s"));
  EXPECT_THAT(svg, HasSubstr("8.0,22.0 320.0,22.0 320.0,99.0 632.0,99.0"));  // full height, then half of it
  EXPECT_EQ(ratePicture({{"seconds", {0}}, {"photons", {0}}}), "");
  EXPECT_EQ(ratePicture({{"seconds", {0, 0}}, {"photons", {0, 5}}}), "") << "no time has passed";
}

TEST(ReportFiles, GoSideBySideWhicheverIsNamed) {
  for (const char* name : {"a/night.json", "a/night.html"}) {
    EXPECT_EQ(reportFiles(name).json, "a/night.json");
    EXPECT_EQ(reportFiles(name).page, "a/night.html");
  }
  EXPECT_EQ(reportFiles("/dev/stdout").json, "/dev/stdout");
  EXPECT_FALSE(reportFiles("/dev/stdout").page);
}

}  // namespace
}  // namespace lucarne::report_page_test
