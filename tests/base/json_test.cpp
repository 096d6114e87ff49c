#include "base/json.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/base/expect_error.h"

namespace lucarne::json_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

json parse(const std::string& text) {
  return parseJson(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "a.json");
}

TEST(DumpJson, IsStableSortedAndIndented) {
  EXPECT_EQ(dumpJson({{"b", {1, 2.5}}, {"a", "x"}}), "{\n  \"a\": \"x\",\n  \"b\": [\n    1,\n    2.5\n  ]\n}\n");
}

TEST(DumpJson, ReadsBackExactly) {
  const json value = {
      {"third", 1.0 / 3}, {"tiny", 5e-324}, {"most", std::numeric_limits<std::uint64_t>::max()}, {"text", "ü\n"}};
  EXPECT_EQ(parse(dumpJson(value)), value);
}

TEST(DumpJson, RefusesNumbersThatAreNotFiniteAndNamesThePlace) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    try {
      dumpJson({{"a", {1, bad}}});
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::logic_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("/a/1"));
    }
  }
}

TEST(DumpJson, ReplacesBytesThatAreNotUtf8) { EXPECT_EQ(dumpJson("a\xff"), "\"a\xef\xbf\xbd\"\n"); }

TEST(ParseJson, NamesFileLineAndColumnOfBadSyntax) {
  EXPECT_THAT(errorOf(ExitCode::badInput, [] { parse("{\n  \"a\": 1,\n  oops\n}"); }),
              AllOf(HasSubstr("a.json"), HasSubstr("line 3, column 3")));
  for (const std::string text : {"", "{", "[1,]", "nan", "1e999", "\"\xff\"", "[1] x", "{\"a\":\"\n\"}", "\x01"}) {
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { parse(text); }), HasSubstr("a.json")) << text;
  }
}

TEST(ParseJson, RefusesDeepNestingButNotBracketsInText) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_TRUE(parse(nested(kMaxJsonDepth)).is_array());
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { parse(nested(kMaxJsonDepth + 1)); }), HasSubstr("deep"));
  EXPECT_THAT(errorOf(ExitCode::badInput, [] { parse(std::string(1'000'000, '[')); }), HasSubstr("deep"));
  std::string quoted(1000, '[');
  quoted.insert(0, "\"\\\"");
  quoted.push_back('"');
  EXPECT_TRUE(parse(quoted).is_string());
}

TEST(JsonView, ReadsEveryKind) {
  const json document = parse(R"({"s": {"list": [1, 2.5, -3], "on": true, "name": "x", "big": 18446744073709551615}})");
  const JsonView view(document, "a.json");
  EXPECT_TRUE(view.has("s"));
  EXPECT_FALSE(view.has("t"));
  const JsonView s = view.at("s");
  EXPECT_EQ(s.at("list").numbers(3), (std::vector<double>{1, 2.5, -3}));
  EXPECT_EQ(s.at("list").at(2).integer(-3, 3), -3);
  EXPECT_EQ(s.at("big").count(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_TRUE(s.at("on").flag());
  EXPECT_EQ(s.at("name").text(), "x");
}

TEST(JsonView, NamesFileAndPlaceOfWhatIsWrong) {
  const json document = parse(R"({"s": {"list": [1, 2.5, -3], "name": "x", "big": 18446744073709551615}})");
  const JsonView s = JsonView(document, "a.json").at("s");
  const auto expectWrong = [](auto get, const char* place) {
    EXPECT_THAT(errorOf(ExitCode::badInput, get), AllOf(HasSubstr("a.json"), HasSubstr(place)));
  };
  expectWrong([&] { s.at("none"); }, "s.none is missing");
  expectWrong([&] { s.at("name").at("x"); }, "s.name must be an object");
  expectWrong([&] { s.at("name").number(); }, "s.name must be a number");
  expectWrong([&] { s.at("name").size(); }, "s.name must be an array");
  expectWrong([&] { s.at("name").flag(); }, "s.name must be true or false");
  expectWrong([&] { s.at("list").text(); }, "s.list must be text");
  expectWrong([&] { s.at("list").at(3); }, "s.list has only 3");
  expectWrong([&] { s.at("list").at(1).count(); }, "s.list[1]");
  expectWrong([&] { s.at("list").at(2).count(); }, "s.list[2]");
  expectWrong([&] { s.at("list").at(2).integer(-2, 9); }, "from -2 to 9");
  expectWrong([&] { s.at("big").integer(0, std::numeric_limits<std::int64_t>::max()); }, "s.big");
  expectWrong([&] { s.at("list").numbers(4); }, "s.list must have 4");
  expectWrong([&] { JsonView(document, "a.json").text(); }, "the document must be text");
}

}  // namespace
}  // namespace lucarne::json_test
