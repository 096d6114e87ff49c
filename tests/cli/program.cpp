#include "tests/cli/program.h"

// Of the address sanitizer's runtime, where it is linked.
extern "C" [[gnu::weak]] void __asan_init();

namespace lucarne::test {

bool isSanitized() { return __asan_init != nullptr; }

}  // namespace lucarne::test
