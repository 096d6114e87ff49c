// Huge pages for large blocks that libraries allocate, as software OpenGL does for its textures: small pages take it longer than
// all that is written into them.
#pragma once

#include <cstddef>

namespace lucarne {

/// While it lives, large blocks of malloc and its kin come from the heap, where room for `bytes` was asked to be in huge pages.
/// Advice: where the system or the allocator declines, nothing changes. One at a time.
class HugeHeap {
 public:
  explicit HugeHeap(std::size_t bytes);
  ~HugeHeap();
  HugeHeap(const HugeHeap&) = delete;
  HugeHeap& operator=(const HugeHeap&) = delete;
};

/// To be called before there is a second thread: all are to allocate from the one heap. Those with one of their own, as glibc
/// gives them, get large blocks from elsewhere, and HugeHeap does not help them.
void shareOneHeap();

/// Gives memory that was freed back to the system, which the heap does not where something lies above it.
void releaseFreedMemory();

}  // namespace lucarne
