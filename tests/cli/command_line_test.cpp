// The program as a user meets it: exit codes, one line for every error, nothing left half-written.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/cli/program.h"

namespace lucarne::command_line_test {
namespace {

namespace fs = std::filesystem;
using test::slurp;
using Outcome = test::ProgramOutcome;

/// A folder of its own for each test; commands run in it.
class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("lucarne_cli_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome run(const std::string& arguments, const std::string& input = "") const {
    write("stdin", input);
    const std::string command =
        "cd '" + folder_.string() + "' && '" + test::programPath() + "' " + arguments + " <stdin >stdout 2>stderr";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(folder_ / "stdout"), slurp(folder_ / "stderr")};
  }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  /// The command fails with `code`, one line that holds `words`, and leaves no file that was not there before.
  void expectRefusal(const std::string& arguments, int code, const std::string& words) const {
    const auto before = listing();
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, code) << arguments << "\n" << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(words), std::string::npos) << arguments << "\n" << o.err;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_EQ(listing(), before) << arguments;
  }

  std::vector<std::string> listing() const {
    std::vector<std::string> names;
    for (const auto& e : fs::recursive_directory_iterator(folder_)) {
      const std::string name = e.path().filename().string();
      if (name != "stdin" && name != "stdout" && name != "stderr") names.push_back(e.path().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path folder_;
};

/// One triangle as .gltf; `positions` is base64 of nine floats, `indices` of three bytes.
std::string triangle(const std::string& positions, const std::string& indices) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":1,"byteLength":3}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         positions + R"("},{"byteLength":3,"uri":"data:application/octet-stream;base64,)" + indices + R"("}]})";
}

// (0,0,0) (1,0,0) (0,1,0); the second with NaN for its first number.
constexpr const char* kGood = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
constexpr const char* kNan = "AADAfwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

TEST_F(CommandLine, MissingSceneIsBadInput) { expectRefusal("bake nothere.glb -o x.dlm", 3, "nothere.glb"); }

TEST_F(CommandLine, TruncatedGlbIsBadInput) {
  write("cut.glb", slurp(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb").substr(0, 3000));
  expectRefusal("bake cut.glb -o x.dlm", 3, "cut.glb");
}

TEST_F(CommandLine, NanVertexIsBadInput) {
  write("nan.gltf", triangle(kNan, "AAEC"));
  expectRefusal("bake nan.gltf -o x.dlm", 3, "nan.gltf");
}

TEST_F(CommandLine, IndexOutOfRangeIsBadInput) {
  write("index.gltf", triangle(kGood, "AAH/"));
  expectRefusal("bake index.gltf -o x.dlm", 3, "255");
}

TEST_F(CommandLine, TheSameTriangleUnharmedBakesToBlackWithAWarning) {
  write("good.gltf", triangle(kGood, "AAEC"));
  const Outcome o = run("bake good.gltf -o x.dlm --photons 10");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("no light"), std::string::npos);
  const Outcome probe = run("probe x.dlm", "0.2 0.2 0 0 0 1\n");
  EXPECT_EQ(nlohmann::json::parse(probe.out)["irradiance"], nlohmann::json({0.0, 0.0, 0.0})) << probe.out;
}

TEST_F(CommandLine, WrongUsageIsRefusedInOneLine) {
  expectRefusal("", 2, "subcommand");
  expectRefusal("frobnicate", 2, "frobnicate");
  expectRefusal("bake", 2, "--output");
  expectRefusal("bake -o x.dlm --photons 0", 2, "--photons");
  expectRefusal("bake -o x.dlm --photons=-3", 2, "--photons");
  expectRefusal("bake -o x.dlm --photons 1e400", 2, "--photons");
  expectRefusal("bake -o x.dlm --directions 0", 2, "--directions");
  expectRefusal("bake -o x.dlm --density nan", 2, "--density");
  expectRefusal("bake -o x.dlm --kernel gauss", 2, "pyramid");
  expectRefusal("bake -o x.dlm --threads -1", 2, "--threads");
  expectRefusal("bake -o x.dlm --no-such-option", 2, "no-such-option");
}

TEST_F(CommandLine, UnwritableOutputIsFoundBeforeTheBake) {
  write("file", "mine");
  expectRefusal("bake -o file/x.dlm --photons 1e9", 1, "file/x.dlm");
  expectRefusal("bake -o missing/folder/x.dlm --photons 1e9", 1, "missing/folder");
  expectRefusal("bake -o file --photons 1e9", 1, "will not replace file");
  EXPECT_EQ(slurp(folder_ / "file"), "mine");
}

TEST_F(CommandLine, ABakeIsRepeatableReplacesItsOwnOutputAndReportsTheAgreedKeys) {
  const std::string bake = "bake -o room.dlm --photons 20k --quiet --report ";
  ASSERT_EQ(run(bake + "a.json").code, 0);
  const Outcome again = run(bake + "b.json --threads 1");
  ASSERT_EQ(again.code, 0);
  EXPECT_EQ(again.err, "");
  const auto a = nlohmann::json::parse(slurp(folder_ / "a.json")), b = nlohmann::json::parse(slurp(folder_ / "b.json"));
  EXPECT_EQ(a["content_hash"], b["content_hash"]);
  for (const char* key : {"photons", "seconds", "photons_per_second", "rays", "rays_per_second", "stored_hits",
                          "charts", "directions", "texels", "tally_bytes", "map_bytes", "peak_memory_bytes",
                          "estimated_relative_error", "content_hash", "left_out"})
    EXPECT_TRUE(a.contains(key)) << key;
  for (const char* key : {"emitted", "absorbed", "escaped", "cut_off", "roulette", "shading_normal"})
    EXPECT_EQ(a["flux_lm"][key].size(), 3u) << key;
  const auto info = nlohmann::json::parse(run("info room.dlm --json").out);
  for (const char* key : {"content_hash", "charts", "texels"}) EXPECT_EQ(info[key], a[key]) << key;
}

TEST_F(CommandLine, ProbeNamesTheLineItCannotRead) {
  ASSERT_EQ(run("bake -o room.dlm --photons 1k --quiet").code, 0);
  const Outcome o = run("probe room.dlm", "0 0 0 0 1 0\n\n1 2 3\n");
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("line 3"), std::string::npos) << o.err;
  EXPECT_EQ(std::count(o.out.begin(), o.out.end(), '\n'), 1) << "the answer to the good line stands";
}

TEST_F(CommandLine, InfoTellsFilesApart) {
  EXPECT_EQ(nlohmann::json::parse(run("info '" LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb' --json").out)["kind"],
            "scene");
  write("text.txt", "hello");
  expectRefusal("info text.txt", 3, "text.txt");
  expectRefusal("info nothere", 3, "nothere");
  expectRefusal("probe text.txt", 3, "text.txt");
}

}  // namespace
}  // namespace lucarne::command_line_test
