// One file written aside and renamed into place: the streaming form of writeFileAtomically, for writers that seek.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace lucarne {

/// The place that a name means: absolute, symbolic links followed, no trailing slash. Error(failed) for an empty path.
std::filesystem::path resolveTarget(const std::filesystem::path& path);

/// A fresh name beside `target` (already resolved); creates nothing. `attempt` makes the names of one process differ.
std::filesystem::path temporarySibling(const std::filesystem::path& target);

/// Removes what killed writers of `target` (already resolved) left beside it. Nobody else may be writing it.
void removeTemporaries(const std::filesystem::path& target);

/// Throws Error(failed), or Error(outOfResource) for a full disk or quota: "cannot WHAT PATH: the system's reason".
[[noreturn]] void throwSystemError(const char* what, const std::filesystem::path& path, int code);

/// Flushes a file or folder to disk. A file's failure throws; a folder's does not (some file systems cannot).
void syncToDisk(const std::filesystem::path& path);

/// Writes go to a hidden sibling that commit() puts in place; without commit() it is removed. An existing device or
/// pipe is written to directly, so that /dev/null is never replaced by a file.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t size);
  void seek(std::uint64_t position);
  std::uint64_t position() const { return flushed_ + buffer_.size(); }
  void commit();

 private:
  void openTemporary();
  void writeThrough(const char* data, std::size_t size);
  void flush();

  std::filesystem::path path_, target_, temporary_;  // temporary_ is empty while writing directly
  int descriptor_ = -1;
  std::uint64_t flushed_ = 0;  // position in the file of the first buffered byte
  std::vector<char> buffer_;
};

}  // namespace lucarne
