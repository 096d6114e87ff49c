#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "base/error.h"

namespace lucarne {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
constexpr int kMaxAttempts = 10000;

constexpr const char* kTemporaryEnd = ".tmp";

/// Hidden, and told apart by what it is for; cut, because names have at most 255 bytes.
std::string temporaryPrefix(const std::filesystem::path& target) {
  return "." + target.filename().string().substr(0, 200) + ".lucarne-";
}

bool isOutOfSpace(int code) { return code == ENOSPC || code == EDQUOT || code == ENOMEM; }

}  // namespace

void throwSystemError(const char* what, const std::filesystem::path& path, int code) {
  const ExitCode exit = isOutOfSpace(code) ? ExitCode::outOfResource : ExitCode::failed;
  throw Error(exit, std::string("cannot ") + what + " " + path.string() + ": " + std::generic_category().message(code));
}

std::filesystem::path resolveTarget(const std::filesystem::path& path) {
  if (path.empty()) throw Error(ExitCode::failed, "cannot write to an empty path: name a file");
  std::error_code error;
  std::filesystem::path target = std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  if (error) throwSystemError("write", path, error.value());
  return target.has_filename() ? target : target.parent_path();
}

std::filesystem::path temporarySibling(const std::filesystem::path& target) {
  static std::atomic<unsigned> count{0};
  const std::string number = std::to_string(::getpid()) + "-" + std::to_string(count++);
  return target.parent_path() / (temporaryPrefix(target) + number + kTemporaryEnd);
}

void removeTemporaries(const std::filesystem::path& target) {
  const std::string prefix = temporaryPrefix(target);
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(target.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(kTemporaryEnd)) std::filesystem::remove_all(entry.path(), ignored);
  }
}

void syncToDisk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0) {
    const int code = errno;
    if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return;
    throwSystemError("flush", path, code);
  }
  const bool isFile = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const int code = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (code != 0 && isFile) throwSystemError("flush", path, code);
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path) {
  buffer_.reserve(kBufferBytes);
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    throw Error(ExitCode::failed, "cannot write " + path.string() + ": it is a folder; name a file");
  }
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) throwSystemError("write", path_, errno);
    return;
  }
  target_ = resolveTarget(path);
  openTemporary();
  // A file that is replaced keeps its permissions. Not being allowed to set them is no reason to lose the work.
  if (exists && ::fchmod(descriptor_, status.st_mode & 07777) != 0) errno = 0;
}

void AtomicFile::openTemporary() {
  // A name may be left over from a killed process that had our number: take the next.
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    temporary_ = temporarySibling(target_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0 || errno != EEXIST) break;
  }
  if (descriptor_ >= 0) return;
  temporary_.clear();
  throwSystemError("write", path_, errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::writeThrough(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throwSystemError("write", path_, errno);
    data += written;
    size -= static_cast<std::size_t>(written);
    flushed_ += static_cast<std::uint64_t>(written);
  }
}

void AtomicFile::flush() {
  writeThrough(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void AtomicFile::write(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  if (buffer_.size() + size > kBufferBytes) flush();
  if (size > kBufferBytes) {
    writeThrough(bytes, size);
  } else {
    buffer_.insert(buffer_.end(), bytes, bytes + size);
  }
}

void AtomicFile::seek(std::uint64_t position) {
  flush();
  if (::lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0) throwSystemError("write", path_, errno);
  flushed_ = position;
}

void AtomicFile::commit() {
  flush();
  if (!temporary_.empty() && ::fsync(descriptor_) != 0) throwSystemError("write", path_, errno);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) throwSystemError("write", path_, errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throwSystemError("write", path_, errno);
  temporary_.clear();
  syncToDisk(target_.parent_path());
}

}  // namespace lucarne
