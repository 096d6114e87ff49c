#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace lucarne {
namespace {

/// The number after `key` at the start of a line of a "key number" file of the kernel; the first number for an empty
/// key.
std::optional<std::uint64_t> kernelNumber(const char* path, const std::string& key) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  if (key.empty()) return file >> value ? std::optional(value) : std::nullopt;
  for (std::string word; file >> word; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    if (word == key) return file >> value ? std::optional(value) : std::nullopt;
  }
  return std::nullopt;
}

/// What the control group leaves (version 2, as seen inside a container). Cached files count as free: the kernel drops
/// them.
std::uint64_t containerAllows() {
  const std::optional<std::uint64_t> limit = kernelNumber("/sys/fs/cgroup/memory.max", "");
  const std::optional<std::uint64_t> used = kernelNumber("/sys/fs/cgroup/memory.current", "");
  if (!limit || !used) return std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t cached = kernelNumber("/sys/fs/cgroup/memory.stat", "inactive_file").value_or(0);
  const std::uint64_t held = *used - std::min(*used, cached);
  return *limit - std::min(*limit, held);
}

}  // namespace

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t residentMemoryBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0, resident = 0;
  return file >> size >> resident ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : peakMemoryBytes();
}

std::uint64_t totalMemoryBytes() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t availableMemoryBytes() {
  const std::optional<std::uint64_t> kibibytes = kernelNumber("/proc/meminfo", "MemAvailable:");
  return std::min(kibibytes ? *kibibytes * 1024 : totalMemoryBytes(), containerAllows());
}

}  // namespace lucarne
