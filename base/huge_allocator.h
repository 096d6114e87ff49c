// Memory of large arrays in huge pages: random reads miss the address cache less often.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace lucarne {

/// For std::vector. Blocks of at least a huge page ask for huge pages; the system may decline, which changes no value.
template <class T>
struct HugeAllocator {
  using value_type = T;
  HugeAllocator() = default;
  template <class U>
  HugeAllocator(const HugeAllocator<U>&) {}

  T* allocate(std::size_t n) {
    constexpr std::size_t kPage = std::size_t{2} << 20, kLine = 64;
    if (n > (std::size_t{1} << 60) / sizeof(T)) throw std::bad_alloc();
    const std::size_t unit = n * sizeof(T) < kPage ? kLine : kPage;
    const std::size_t bytes = (n * sizeof(T) + unit - 1) / unit * unit;
    void* block = std::aligned_alloc(unit, bytes);
    if (block == nullptr) throw std::bad_alloc();
    if (unit == kPage) madvise(block, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t) { std::free(block); }
  friend bool operator==(HugeAllocator, HugeAllocator) { return true; }
};

}  // namespace lucarne
