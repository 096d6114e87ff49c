// The program run as a user runs it, in a folder of the test's own.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace lucarne::test {

/// A scene that loads at once, with maps for all directions, as options of a bake.
inline constexpr const char* kQuickScene = " '" LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb' --keep-all-directions ";

/// The program of the build that the running test is of.
inline std::string programPath() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "cli" / "lucarne").string();
}

/// With the address sanitizer what was freed is kept, and programs need far more memory than without.
bool isSanitized();

struct ProgramOutcome {
  int code;
  std::string out, err;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(info->test_suite_name()) + "_" + info->name();
    for (char& c : name)
      if (c == '/') c = '_';
    folder_ = std::filesystem::path(testing::TempDir()) / ("lucarne_" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A line for the shell, run in the folder, with the program as $LUCARNE.
  ProgramOutcome shell(const std::string& line) const {
    const std::string command =
        "cd '" + folder_.string() + "' && export LUCARNE='" + programPath() + "' && { " + line + "; } >stdout 2>stderr";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(folder_ / "stdout"), slurp(folder_ / "stderr")};
  }
  ProgramOutcome run(const std::string& arguments) const { return shell("\"$LUCARNE\" " + arguments); }

  /// Fails the test unless the command ends with 0.
  void mustRun(const std::string& arguments) const {
    const ProgramOutcome o = run(arguments);
    ASSERT_EQ(o.code, 0) << arguments << "\n" << o.err;
  }

  std::string contentHash(const std::string& name) const {
    const ProgramOutcome o = run("info " + name + " --json");
    return o.code == 0 ? nlohmann::json::parse(o.out)["content_hash"].get<std::string>() : "no hash: " + o.err;
  }
  /// True when two folders or files hold the same bytes.
  bool same(const std::string& a, const std::string& b) const { return shell("diff -r " + a + " " + b).code == 0; }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  std::filesystem::path folder_;
};

/// A command in the background, in a process group of its own, that can be killed with all its children.
class Background {
 public:
  Background(const std::filesystem::path& folder, const std::string& line) : pid_(::fork()) {
    // On both sides, so that the group is there whoever runs first.
    ::setpgid(pid_, pid_);
    if (pid_ != 0) return;
    const std::string command =
        "cd '" + folder.string() + "' && export LUCARNE='" + programPath() + "' && exec " + line + " >>log 2>&1";
    ::execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ~Background() { kill(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  bool running() {
    if (pid_ > 0 && ::waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
    return pid_ > 0;
  }
  int pid() const { return static_cast<int>(pid_); }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
    pid_ = 0;
  }
  /// Waits for its end.
  int exitCode() {
    if (pid_ > 0) ::waitpid(pid_, &status_, 0);
    pid_ = 0;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  pid_t pid_;
  int status_ = 0;
};

}  // namespace lucarne::test
