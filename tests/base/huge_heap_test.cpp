#include "base/huge_heap.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <thread>

namespace lucarne::huge_heap_test {
namespace {

TEST(HugeHeap, LargeBlocksAreAsGoodAsOthersOnAnyThread) {
  constexpr std::size_t kBytes = std::size_t{96} << 20;
  const auto allocate = [] {
    const HugeHeap heap(kBytes);
    void* block = nullptr;
    ASSERT_EQ(posix_memalign(&block, 64, kBytes), 0);
    std::memset(block, 1, kBytes);
    std::free(block);
  };
  allocate();
  std::thread(allocate).join();
  releaseFreedMemory();
  void* const after = std::malloc(kBytes);
  ASSERT_NE(after, nullptr);
  std::free(after);
}

}  // namespace
}  // namespace lucarne::huge_heap_test
