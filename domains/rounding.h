// SPDX-License-Identifier: Apache-2.0
// The one place that touches the floating-point environment. Kernels (interval/kernel.h) assume upward
// rounding with gradual underflow; the guards set it and leave the caller's environment exactly as found.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace hcsp {

/// Keeps the compiler from moving a floating-point operation on x across a guard.
inline double opaque(double x) {
#if defined(__SSE2__)
  asm volatile("" : "+x"(x) : : "memory");
#else
  asm volatile("" : "+w"(x) : : "memory");
#endif
  return x;
}

/// RAII guard: rounding direction set on this thread (flush-to-zero off, exceptions masked), restored on
/// exit.
template <bool kUpward>
class RoundingGuard {
 public:
#if defined(__SSE2__)
  RoundingGuard() : saved_(_mm_getcsr()) {
    // MXCSR: all exceptions masked (0x1f80), rounding field 10 = toward +oo (0x4000), FTZ and DAZ clear.
    constexpr unsigned kWanted = kUpward ? 0x5f80U : 0x1f80U;
    constexpr unsigned kControl = 0xffc0U;  // everything but the sticky exception flags
    if ((saved_ & kControl) != kWanted) _mm_setcsr(kWanted | (saved_ & ~kControl));
    asm volatile("" ::: "memory");
  }
  ~RoundingGuard() {
    asm volatile("" ::: "memory");
    if ((_mm_getcsr() ^ saved_) & 0xffc0U) _mm_setcsr(saved_);
    asm volatile("" ::: "memory");
  }
#else
  RoundingGuard() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
    std::fesetround(kUpward ? FE_UPWARD : FE_TONEAREST);
    asm volatile("" ::: "memory");
  }
  ~RoundingGuard() {
    asm volatile("" ::: "memory");
    std::fesetenv(&saved_);
  }
#endif
  RoundingGuard(const RoundingGuard&) = delete;
  RoundingGuard& operator=(const RoundingGuard&) = delete;

 private:
#if defined(__SSE2__)
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

using RoundUpward = RoundingGuard<true>;
using RoundNearest = RoundingGuard<false>;

}  // namespace hcsp
