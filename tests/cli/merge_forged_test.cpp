// Parts that are whole and sealed but lie: nothing crashes, and the answer is one line that names the file.
#include "distributed/part_file.h"
#include "tests/cli/merge_fixture.h"

namespace lucarne::merge_forged_test {
namespace {

class ForgedParts : public test::MergeTest {
 protected:
  /// a.part with some of it changed, sealed anew.
  template <class Change>
  void forge(Change change) const {
    const PartReader part(folder_ / "a.part");
    PartHeader header = part.header();
    Tallies tallies(header.lightEntries, header.texels);
    std::vector<std::uint8_t> scene;
    addPart(part, tallies, &scene);
    change(header, scene, tallies);
    writePart(folder_ / "x.part", header, scene, tallies);
  }
  void expectNamed() const { expectRefused("merge x.part -o out.dlm --quiet", 4, {"x.part"}); }
};

TEST_F(ForgedParts, TalliesOfAnotherSizeThanTheLayoutAreRefused) {
  forge([](PartHeader&, std::vector<std::uint8_t>&, Tallies& t) { t = Tallies(1, 1); });
  expectNamed();
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies& t) { t = Tallies(1, h.texels); });
  expectNamed();
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies& t) { t = Tallies(h.lightEntries - 1, h.texels); });
  expectNamed();
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies& t) { t = Tallies(h.lightEntries, h.texels + 1); });
  expectNamed();
}

TEST_F(ForgedParts, ScenesThatAreNoneAreRefused) {
  for (const std::string text : {"", "glTF", "{}", "no scene at all"}) {
    forge([&](PartHeader& h, std::vector<std::uint8_t>& scene, Tallies&) {
      scene.assign(text.begin(), text.end());
      h.identity.scene = hashBytes(scene);
    });
    expectNamed();
  }
}

TEST_F(ForgedParts, SettingsThatNoBakeHasAreRefused) {
  using nlohmann::json;
  const std::pair<const char*, json> rows[] = {{"directions", 0},
                                               {"directions", 100'000},
                                               {"texels_per_metre", -1},
                                               {"texels_per_metre", 1e300},
                                               {"texel_budget", 0},
                                               {"light", "none"},
                                               {"light", 3},
                                               {"depth_limit", 7},
                                               {"direction_filter", 1},
                                               {"keep_all_directions", "yes"}};
  for (const auto& [key, value] : rows) {
    SCOPED_TRACE(key);
    forge([&, k = key, v = value](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) { h.identity.settings[k] = v; });
    expectNamed();
  }
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) { h.identity.settings = json::object(); });
  expectNamed();
  for (const json& width : {json(0), json(1e9), json("wide")}) {
    forge([&](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) { h.identity.resolve["kernel_width"] = width; });
    expectNamed();
  }
}

TEST_F(ForgedParts, LayoutsOfOtherVersionsAreRefused) {
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) { h.identity.layout.lo ^= 1; });
  expectRefused("merge x.part -o out.dlm --quiet", 4, {"x.part was altered"});
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) {
    h.identity.layout.lo ^= 1;
    Maker other = *h.makers.begin();
    other.build = "lucarne 9.9";
    h.makers = {other};
  });
  expectRefused("merge x.part -o out.dlm --quiet", 4, {"x.part was laid out by lucarne 9.9"});
  expectRefused("merge x.part b.part -o out.dlm --quiet", 4, {"x.part and b.part differ in layout"});
}

TEST_F(ForgedParts, FluxBeyondAllNumbersCrashesNothing) {
  for (const double flux : {1e300, 1e308, -1.0}) {
    forge([&](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) { h.identity.emittedFlux = flux; });
    const auto o = run("merge x.part -o out.dlm --quiet");
    EXPECT_TRUE(o.code == 0 || o.code == 4) << flux << "\n" << o.err;
    EXPECT_EQ(o.err.find("internal error"), std::string::npos) << flux << "\n" << o.err;
    const auto info = run("info x.part");
    EXPECT_TRUE(info.code == 0 || info.code == 3) << flux << "\n" << info.err;
    EXPECT_EQ(info.err.find("internal error"), std::string::npos) << flux << "\n" << info.err;
  }
}

TEST_F(ForgedParts, PlansOfMorePartsThanABakeHasAreRefused) {
  for (const std::uint64_t parts :
       {kMostParts + 1, std::uint64_t{1} << 62, std::numeric_limits<std::uint64_t>::max()}) {
    forge([&](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) { h.planned.parts = parts; });
    expectRefused("merge x.part --verify", 4, {"x.part: planned.parts"});
  }
}

TEST_F(ForgedParts, APlanOfManyPartsHoldsNothingUp) {
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies&) {
    h.planned = {std::numeric_limits<std::uint64_t>::max(), kMostParts};
  });
  const auto o = run("merge x.part --verify");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("missing"), std::string::npos) << o.err;
}

TEST_F(ForgedParts, AStateOfAnotherSizeIsPassedOver) {
  std::filesystem::create_directory(folder_ / "a.checkpoint");
  forge([](PartHeader& h, std::vector<std::uint8_t>&, Tallies& t) { t = Tallies(h.lightEntries, h.texels + 1); });
  std::filesystem::rename(folder_ / "x.part", folder_ / "a.checkpoint" / "state-000001.part");
  const std::string hash = contentHash("a.part");
  const auto o =
      run(std::string("bake") + test::kQuickScene + "--photons 2k --density 2 -o a.part --part 1/2 --resume");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err.find("internal error"), std::string::npos) << o.err;
  EXPECT_EQ(contentHash("a.part"), hash);
}

}  // namespace
}  // namespace lucarne::merge_forged_test
