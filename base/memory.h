// What memory this process has used and may use.
#pragma once

#include <cstdint>

namespace lucarne {

/// The most that was resident at once since the start.
std::uint64_t peakMemoryBytes();
/// What is resident now.
std::uint64_t residentMemoryBytes();
/// What can be taken without swapping: what the system has free or reclaimable, and within the container's limit.
std::uint64_t availableMemoryBytes();
/// Of the machine.
std::uint64_t totalMemoryBytes();

}  // namespace lucarne
