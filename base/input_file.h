// A regular file opened for reading: what readFile and the streaming image reader share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace lucarne {

/// Refuses folders, pipes and devices. All failures are InputErrors that name the path.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Length when it was opened.
  std::uint64_t size() const { return size_; }
  /// Up to `count` bytes from `offset`; fewer only at the end of the file.
  std::size_t read(std::uint64_t offset, void* into, std::size_t count) const;
  /// Asks the system to fetch these bytes from disk while we do something else.
  void prefetch(std::uint64_t offset, std::size_t count) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace lucarne
