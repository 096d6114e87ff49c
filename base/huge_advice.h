// Fresh memory in huge pages: a fault for every 2 MiB instead of every 4 KiB, which is most of the time that filling
// gigabytes takes.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace lucarne {

/// For memory that is reserved and not yet written. Advice: the system may decline, which changes no value.
inline void askForHugePages(void* block, std::size_t bytes) {
  constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;
  const auto start = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (start + kPage - 1) / kPage * kPage, end = (start + bytes) / kPage * kPage;
  if (end > first) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

}  // namespace lucarne
