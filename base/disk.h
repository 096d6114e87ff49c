// Room on disks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace lucarne {

/// What a process like this one may still write on the disk where `path`, or the nearest folder above it that is there,
/// lies. Nothing where the file system does not tell. Quotas are not known.
std::optional<std::uint64_t> freeDiskBytes(const std::filesystem::path& path);

/// True when both lie on one disk.
bool onSameDisk(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lucarne
