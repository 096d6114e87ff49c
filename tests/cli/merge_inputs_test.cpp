// What a merge can be given, where it writes, and what it says of photons that are missing.
#include "tests/cli/merge_fixture.h"

namespace lucarne::merge_inputs_test {
namespace {

namespace fs = std::filesystem;

class MergeInputs : public test::MergeTest {
 protected:
  void bakeWhole() const { bake("-o whole.dlm"); }
  void removeHalves() const {
    fs::remove(folder_ / "a.part");
    fs::remove(folder_ / "b.part");
  }
  /// The command that a warning names: from `lucarne bake` to the end of the line.
  static std::string commandIn(const std::string& text) {
    const std::size_t at = text.find("lucarne bake");
    return at == std::string::npos ? "none" : text.substr(at, text.find('\n', at) - at);
  }
  /// Runs it as typed, with this build's program for `lucarne`.
  int runCommand(const std::string& command) const {
    return shell("lucarne() { \"$LUCARNE\" \"$@\"; }; " + command).code;
  }
};

TEST_F(MergeInputs, WhatIsNotThereOrNoPartIsBadInput) {
  bakeWhole();
  fs::create_directory(folder_ / "empty");
  fs::create_directory(folder_ / "folder.part");
  write("list", "a.part\nnone.part\n");
  write("nested", "@list\n");
  expectRefused("merge a.part none.part -o out.dlm", 3, {"none.part"});
  expectRefused("merge none/ -o out.dlm", 3, {"none"});
  expectRefused("merge a.part whole.dlm -o out.dlm", 3, {"whole.dlm is a folder of finished light maps"});
  expectRefused("merge a.part empty -o out.dlm", 3, {"empty holds no .part files"});
  expectRefused("merge a.part folder.part -o out.dlm", 3, {"folder.part"});
  expectRefused("merge @list -o out.dlm", 3, {"none.part"});
  expectRefused("merge @none -o out.dlm", 3, {"none"});
  expectRefused("merge @nested -o out.dlm", 3, {"nested"});
  expectRefused("merge @empty -o out.dlm", 3, {"empty"});
}

TEST_F(MergeInputs, NamesThatNoFileCanHaveAreBadInput) {
  fs::create_symlink("loop.part", folder_ / "loop.part");
  expectRefused("merge a.part loop.part -o out.dlm", 3, {"loop.part"});
  expectRefused("merge a.part " + std::string(300, 'n') + ".part -o out.dlm", 3, {"nnn"});
  expectRefused("merge a.part a.part/b.part -o out.dlm", 3, {"a.part/b.part"});
  expectRefused("merge @a.part -o out.dlm", 3, {"a.part"});
  expectRefused("merge '' -o out.dlm", 3, {});
}

TEST_F(MergeInputs, AMissingFileOfAListIsNamedWithTheList) {
  write("list.txt", "a.part\nnone.part\n");
  expectRefused("merge @list.txt -o out.dlm", 3, {"none.part", "list.txt"});
}

TEST_F(MergeInputs, AnEmptyListIsWrongUsage) {
  write("list", "# nothing\n\n");
  expectRefused("merge @list -o out.dlm", 2, {"no parts to merge"});
}

TEST_F(MergeInputs, WrongUsageIsRefused) {
  expectRefused("merge", 2, {"PARTS"});
  expectRefused("merge a.part b.part", 2, {"-o"});
  expectRefused("merge -o out.dlm", 2, {"PARTS"});
  expectRefused("merge a.part b.part -o out.dlm --kernel gauss", 2, {"pyramid"});
  expectRefused("merge a.part b.part -o out.dlm --kernel-width 100", 2, {"--kernel-width"});
  expectRefused("merge a.part b.part -o out.dlm --format rgb", 2, {"half"});
  expectRefused("merge a.part b.part -o out.dlm --no-such-option", 2, {"no-such-option"});
}

TEST_F(MergeInputs, AnInputIsNeverTheOutput) {
  fs::create_symlink("a.part", folder_ / "link.part");
  fs::create_hard_link(folder_ / "a.part", folder_ / "hard.part");
  for (const char* output : {"a.part", "./a.part", "b.part", "link.part", "hard.part"})
    expectRefused(std::string("merge a.part b.part -o ") + output, 2, {"both a part to merge and the output"});
  expectRefused("merge . -o a.part", 2, {"both a part to merge and the output"});
}

TEST_F(MergeInputs, AnInputIsNeverTheReport) {
  const auto before = contents();
  const auto o = run("merge a.part b.part -o out.dlm --report a.part");
  EXPECT_EQ(o.code, 2) << o.err;
  EXPECT_TRUE(contents() == before) << "files were written or touched";
}

TEST_F(MergeInputs, WhatIsSomethingElseIsNotReplaced) {
  write("mine.dlm", "text");
  write("mine.part", "text");
  fs::create_directory(folder_ / "folder.dlm");
  write("folder.dlm/notes.txt", "mine");
  fs::create_directory(folder_ / "folder.part");
  for (const char* output : {"mine.dlm", "mine.part", "folder.dlm", "folder.part"})
    expectRefused(std::string("merge a.part b.part -o ") + output, 1, {"will not replace " + std::string(output)});
  expectRefused("merge a.part b.part -o missing/out.dlm", 1, {"missing/out.dlm"});
  expectRefused("merge a.part b.part -o mine.dlm/out.part", 1, {"mine.dlm/out.part"});
  expectRefused("merge a.part b.part -o out.dlm --report missing/r.json", 1, {"missing/r.json"});
}

TEST_F(MergeInputs, FoldersAndListsStandForTheirParts) {
  bakeWhole();
  fs::create_directory(folder_ / "in");
  fs::rename(folder_ / "a.part", folder_ / "in" / "a.part");
  fs::rename(folder_ / "b.part", folder_ / "in" / "b.part");
  write("in/notes.txt", "no part");
  write("in/list", "# the second\r\n\r\nb.part\r\na.part\r\n");
  write("some", "in/b.part\n");
  for (const char* inputs :
       {"in", "in/", "in/a.part in/b.part", "in/b.part in/a.part", "@in/list", "@some in/a.part", "in/*.part"}) {
    mustRun(std::string("merge --quiet --complete -o out.dlm ") + inputs);
    EXPECT_TRUE(same("out.dlm", "whole.dlm")) << inputs;
    fs::remove_all(folder_ / "out.dlm");
  }
}

TEST_F(MergeInputs, AMergeReplacesItsOwnOutputAndLeavesItsInputs) {
  const std::string a = read("a.part"), b = read("b.part");
  for (const char* output : {"out.dlm", "out.part", "out.dlm", "out.part"})
    mustRun(std::string("merge a.part b.part --quiet -o ") + output);
  EXPECT_EQ(read("a.part"), a);
  EXPECT_EQ(read("b.part"), b);
  EXPECT_EQ(contentHash("out.dlm"), contentHash("out.part"));
}

TEST_F(MergeInputs, VerifyingWritesNothing) {
  const auto before = contents();
  const auto o = run("merge a.part b.part --verify");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("all is well: 2 parts, 2000 photons"), std::string::npos) << o.err;
  EXPECT_EQ(run("merge a.part b.part --verify -o out.dlm").code, 0);
  EXPECT_TRUE(contents() == before);
}

TEST_F(MergeInputs, MissingPartsAreCountedAndTheCommandNamedBakesThem) {
  fs::copy_file(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb", folder_ / "it's a box.glb");
  removeHalves();
  const std::string bakeBox =
      "bake \"it's a box.glb\" --photons 2k --density 2.3 --seed 3 --directions 9 --light indirect --quiet ";
  mustRun(bakeBox + "-o whole.dlm");
  mustRun(bakeBox + "-o 1.part --part 1/3");
  mustRun(bakeBox + "-o 3.part --part 3/3");
  const auto o = run("merge 1.part 3.part -o gap.dlm");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("1 of 3 parts missing, photons 666..1333"), std::string::npos) << o.err;
  expectRefused("merge 1.part 3.part -o out.dlm --complete", 4, {"1 of 3 parts missing", "lucarne bake", "--part 2/3"});
  const std::string command = commandIn(o.err);
  EXPECT_EQ(runCommand(command), 0) << command;
  mustRun("merge . -o all.dlm --complete --quiet");
  EXPECT_EQ(contentHash("all.dlm"), contentHash("whole.dlm"));
  EXPECT_TRUE(same("all.dlm", "whole.dlm"));
  EXPECT_NE(contentHash("gap.dlm"), contentHash("whole.dlm"));
}

TEST_F(MergeInputs, MissingRangesAreNamedAndTheCommandsNamedBakeThem) {
  fs::copy_file(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb", folder_ / "box.glb");
  const std::string bakeBox =
      "bake box.glb --photons 2k --density 0.1 --kernel box --kernel-width 2.5 --texels 123456 --quiet ";
  mustRun(bakeBox + "-o whole.dlm");
  removeHalves();
  mustRun(bakeBox + "-o x.part --photon-range 100:700");
  mustRun(bakeBox + "-o y.part --photon-range 1001:1002");
  const auto o = run("merge x.part y.part --verify");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("photons 0..100, 700..1001, 1002..2k missing"), std::string::npos) << o.err;
  EXPECT_EQ(runCommand(commandIn(o.err)), 0) << o.err;
  mustRun("merge . -o all.dlm --complete --quiet");
  EXPECT_TRUE(same("all.dlm", "whole.dlm"));
}

TEST_F(MergeInputs, TheCommandNamedCanBeTypedForAnySceneName) {
  removeHalves();
  for (const std::string name : {"-box.glb", "$HOME `box`.glb", "\"box\" & b\xc3\xb6x.glb"}) {
    SCOPED_TRACE(name);
    fs::copy_file(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb", folder_ / name);
    const auto made = shell("\"$LUCARNE\" bake ./*box*.glb -o half.part --part 1/2" + std::string(kTiny));
    ASSERT_EQ(made.code, 0) << made.err;
    const auto o = run("merge half.part --verify");
    EXPECT_EQ(runCommand(commandIn(o.err)), 0) << o.err;
    EXPECT_EQ(run("merge . --verify --complete").code, 0) << o.err;
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
  }
}

TEST_F(MergeInputs, ManyMissingPartsAreCutShortInOneLine) {
  bake("-o 7.part --part 7/20");
  const auto o = run("merge 7.part -o gap.dlm");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("19 of 20 parts missing"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("15 more like these"), std::string::npos) << o.err;
}

TEST_F(MergeInputs, APartTellsWhatItHolds) {
  mustRun("merge a.part b.part -o all.part --quiet");
  const auto info = [this](const std::string& name) {
    return nlohmann::json::parse(run("info " + name + " --json").out);
  };
  const nlohmann::json a = info("a.part"), all = info("all.part");
  EXPECT_EQ(a["kind"], "part");
  EXPECT_EQ(a["photon_ranges"], nlohmann::json::parse("[[0, 1000]]"));
  EXPECT_EQ(a["photons"], 1000);
  EXPECT_EQ(a["settings"]["directions"], 14);
  EXPECT_EQ(a["settings"]["seed"], 0);
  EXPECT_EQ(a["content_hash"].get<std::string>().size(), 32u);
  EXPECT_EQ(all["photon_ranges"], nlohmann::json::parse("[[0, 2000]]"));
  EXPECT_NE(all["content_hash"], a["content_hash"]);
  EXPECT_EQ(all["settings_hash"], a["settings_hash"]);
  const std::string text = run("info a.part").out;
  for (const char* word : {"kind: part", "content_hash: ", "photon_ranges: [[0,1000]]", "missing: 1k..2k"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

TEST_F(MergeInputs, TheReportIsThatOfTheWholeBake) {
  mustRun(std::string("bake") + test::kQuickScene + kTiny + "-o whole.dlm --report whole.json");
  mustRun("merge b.part a.part -o all.dlm --quiet --report all.json");
  const auto whole = nlohmann::json::parse(read("whole.json")), all = nlohmann::json::parse(read("all.json"));
  for (const char* key : {"photons", "rays", "stored_hits", "flux_lm", "charts", "directions", "texels", "tally_bytes",
                          "map_bytes", "estimated_relative_error", "content_hash", "left_out", "settings"})
    EXPECT_EQ(all[key], whole[key]) << key;
  EXPECT_EQ(all["parts"], 2);
  EXPECT_EQ(all["missing_photons"], nlohmann::json::array());
}

}  // namespace
}  // namespace lucarne::merge_inputs_test
