#include "base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "base/error.h"

namespace lucarne {
namespace {

[[noreturn]] void throwUnreadable(const std::filesystem::path& path, const std::string& reason) {
  throw InputError("cannot read " + path.string() + ": " + reason);
}

[[noreturn]] void throwUnreadable(const std::filesystem::path& path, int code) {
  throwUnreadable(path, std::generic_category().message(code));
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : path_(path) {
  // Non-blocking, so that opening a pipe that nobody writes to does not wait for ever.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) throwUnreadable(path, errno);
  struct stat status {};
  const int code = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
  if (code == 0 && S_ISREG(status.st_mode)) {
    size_ = static_cast<std::uint64_t>(status.st_size);
    return;
  }
  ::close(descriptor_);
  if (code != 0) throwUnreadable(path, code);
  throwUnreadable(path, S_ISDIR(status.st_mode) ? "it is a folder; name a file" : "it is not a regular file");
}

InputFile::~InputFile() { ::close(descriptor_); }

void InputFile::prefetch(std::uint64_t offset, std::size_t count) const {
  // Advice only: what the system makes of it changes no result.
  ::posix_fadvise(descriptor_, static_cast<off_t>(offset), static_cast<off_t>(count), POSIX_FADV_WILLNEED);
}

std::size_t InputFile::read(std::uint64_t offset, void* into, std::size_t count) const {
  char* bytes = static_cast<char*>(into);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(descriptor_, bytes + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throwUnreadable(path_, errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace lucarne
