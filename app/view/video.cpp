#include "app/view/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr const char* kProgram = "ffmpeg";

bool isInPath() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!folder.empty() && ::access((std::filesystem::path(folder) / kProgram).c_str(), X_OK) == 0) return true;
  }
  return false;
}

/// Runs the program, what it says going to `log`; true when it ends well.
bool run(std::vector<std::string> words, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, kProgram, &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throwSystemError("run", kProgram, failure);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The last line that is not empty.
std::string lastWords(const std::filesystem::path& log) {
  const std::vector<std::uint8_t> bytes = readFile(log, std::uint64_t{1} << 24);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::string last = "no reason given";
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) last = line.substr(0, 200);
  }
  return last;
}

/// A file of this program's own, removed at the end.
struct Temporary {
  explicit Temporary(const std::filesystem::path& beside) : path(temporarySibling(beside)) {}
  ~Temporary() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  std::filesystem::path path;
};

}  // namespace

bool makeVideo(const std::filesystem::path& folder, double fps, const std::filesystem::path& output) {
  if (!isInPath()) return false;
  const std::filesystem::path target = resolveTarget(output);
  removeTemporaries(target);
  const Temporary made(target), log(target);
  // Sides of this kind of video are even; every player shows 4:2:0.
  if (!run({kProgram,
            "-nostdin",
            "-hide_banner",
            "-loglevel",
            "error",
            "-y",
            "-framerate",
            formatNumber(fps),
            "-i",
            (folder / "frame_%05d.png").string(),
            "-vf",
            "pad=ceil(iw/2)*2:ceil(ih/2)*2",
            "-c:v",
            "libx264",
            "-crf",
            "18",
            "-pix_fmt",
            "yuv420p",
            "-f",
            "mp4",
            made.path.string()},
           log.path))
    throw Error(ExitCode::failed, "the frames are there, but ffmpeg made no video of them: " + lastWords(log.path));
  syncToDisk(made.path);
  std::error_code failure;
  std::filesystem::rename(made.path, target, failure);
  if (failure) throwSystemError("write", target, failure.value());
  return true;
}

}  // namespace lucarne
