#include "base/huge_heap.h"

#include <malloc.h>

#include <cstdlib>

#include "base/huge_advice.h"

namespace lucarne {

#ifdef __GLIBC__

// The room is allocated, advised and freed again; without trimming it stays, untouched, for whoever allocates next. Blocks of
// mmap() would be fresh each time, hence none while this lives. Afterwards the thresholds are the largest of those that glibc
// would have moved them to by itself.
HugeHeap::HugeHeap(std::size_t bytes) {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  void* const room = std::malloc(bytes);
  if (room == nullptr) return;
  askForHugePages(room, bytes);
  std::free(room);
}

HugeHeap::~HugeHeap() {
  constexpr int kMappedBlocks = 65536, kLargestInHeap = 32 << 20;
  mallopt(M_MMAP_MAX, kMappedBlocks);
  mallopt(M_MMAP_THRESHOLD, kLargestInHeap);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargestInHeap);
}

void shareOneHeap() { mallopt(M_ARENA_MAX, 1); }
void releaseFreedMemory() { malloc_trim(0); }

#else

HugeHeap::HugeHeap(std::size_t) {}
HugeHeap::~HugeHeap() = default;
void shareOneHeap() {}
void releaseFreedMemory() {}

#endif

}  // namespace lucarne
