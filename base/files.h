// Reading and writing whole files and folders. Every write goes aside, is flushed to disk, then renamed into place, so that
// a crash leaves the old file or the new one, never half of one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lucarne {

/// Whole file; InputError when it is missing, unreadable, a folder, or larger than `limit`.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t limit = std::uint64_t{4} << 30);

/// Error(failed), or Error(outOfResource) when the disk is full; names the path and the system's reason.
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void writeFileAtomically(const std::filesystem::path& path, const std::string& text);

/// Bytes of one file as another, a block at a time.
void copyFileAtomically(const std::filesystem::path& from, const std::filesystem::path& to);

/// Calls `fill(folder)` with a fresh temporary sibling folder, flushes all that it wrote, then puts it in the place of `path`
/// in one step (renameat2 EXCHANGE when `path` exists; falls back to two renames where the file system lacks it). An existing
/// `path` is only replaced when `mayReplace(path)` is true (else Error(failed)); the temporary is removed on any failure.
void writeFolderAtomically(const std::filesystem::path& path, const std::function<bool(const std::filesystem::path&)>& mayReplace,
                           const std::function<void(const std::filesystem::path&)>& fill);

/// Throws Error(failed) when a file or folder cannot be created at `path` (missing or read-only parent): asked before hours are spent.
void checkWritable(const std::filesystem::path& path);

}  // namespace lucarne
