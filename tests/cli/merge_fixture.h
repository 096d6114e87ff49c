// Two halves of a tiny bake, and merges that must be refused: one line, the right exit code, nothing written or
// touched.
#pragma once

#include <algorithm>
#include <cstring>
#include <map>

#include "tests/cli/program.h"

namespace lucarne::test {

class MergeTest : public ProgramTest {
 protected:
  static constexpr const char* kTiny = " --photons 2k --density 2 --quiet ";

  void SetUp() override {
    ProgramTest::SetUp();
    bake("-o a.part --part 1/2");
    bake("-o b.part --part 2/2");
  }

  /// The quick scene and tiny settings, then these options.
  void bake(const std::string& options) const { mustRun(std::string("bake") + kQuickScene + kTiny + options); }

  /// Everything in the folder but what run() leaves there: bytes by name.
  std::map<std::string, std::string> contents() const {
    namespace fs = std::filesystem;
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      const std::string name = entry.path().lexically_relative(folder_).string();
      if (name == "stdout" || name == "stderr") continue;
      all[name] = fs::is_regular_file(entry.symlink_status()) ? slurp(entry.path()) : "no file";
    }
    return all;
  }

  /// The command is refused with `code` and one line that has all of `words`.
  void expectRefused(const std::string& command, int code, const std::vector<std::string>& words) const {
    const auto before = contents();
    const ProgramOutcome o = run(command);
    EXPECT_EQ(o.code, code) << command << "\n" << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << command << "\n" << o.err;
    EXPECT_EQ(o.err.find("internal error"), std::string::npos) << command << "\n" << o.err;
    for (const std::string& word : words)
      EXPECT_NE(o.err.find(word), std::string::npos) << command << "\n" << word << "\n" << o.err;
    EXPECT_EQ(o.out, "") << command;
    EXPECT_TRUE(contents() == before) << command << ": files were written or touched";
  }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::string read(const std::string& name) const { return slurp(folder_ / name); }
};

}  // namespace lucarne::test
