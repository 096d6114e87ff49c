#include "base/huge_buffer.h"

#include <sys/mman.h>

#include <string>

#include "base/error.h"

namespace lucarne {

PageBlock::PageBlock(std::size_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  void* p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (p == MAP_FAILED) throw Error(ExitCode::outOfResource, "out of memory: " + std::to_string(bytes >> 20) + " MiB asked for");
  madvise(p, bytes, MADV_HUGEPAGE);  // a wish: small pages work too
  data_ = p;
}

PageBlock::~PageBlock() {
  if (data_ != nullptr) munmap(data_, bytes_);
}

}  // namespace lucarne
