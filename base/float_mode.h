// Denormal floats flushed to zero while an object lives, on the thread it lives on. Embree asks for it, and it must be the
// same everywhere, since it changes bits.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace lucarne {

class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
  ~FlushDenormals() { _mm_setcsr(saved_); }
#else
  FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kFlushToZero = 0x8000u, kDenormalsAreZero = 0x0040u;
  unsigned saved_;
#endif
};

}  // namespace lucarne
