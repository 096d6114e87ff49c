#include "base/disk.h"

#include <sys/stat.h>
#include <sys/statvfs.h>

namespace lucarne {
namespace {

/// The path, or the nearest folder above it that is there.
std::filesystem::path present(const std::filesystem::path& path) {
  std::error_code none;
  std::filesystem::path place = std::filesystem::absolute(path, none);
  while (!std::filesystem::exists(place, none) && place.has_relative_path()) place = place.parent_path();
  return place;
}

}  // namespace

std::optional<std::uint64_t> freeDiskBytes(const std::filesystem::path& path) {
  struct statvfs status {};
  if (::statvfs(present(path).c_str(), &status) != 0 || status.f_blocks == 0) return std::nullopt;
  return static_cast<std::uint64_t>(status.f_bavail) * status.f_frsize;
}

bool onSameDisk(const std::filesystem::path& a, const std::filesystem::path& b) {
  struct stat first {
  }, second{};
  return ::stat(present(a).c_str(), &first) == 0 && ::stat(present(b).c_str(), &second) == 0 &&
         first.st_dev == second.st_dev;
}

}  // namespace lucarne
