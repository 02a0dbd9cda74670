// SPDX-License-Identifier: Apache-2.0
// The floating-point environment of an embedding program, for tests: any rounding mode, and where the machine
// has them the flags that drop subnormal numbers.
#pragma once

#include <array>
#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace hcsp::oracle {

inline constexpr std::array kRoundingModes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

/// Sets an environment for a scope.
class Environment {
 public:
  Environment(int mode, bool flush) {
    std::fegetenv(&saved_);
    std::fesetround(mode);
#if defined(__SSE2__)
    if (flush) _mm_setcsr(_mm_getcsr() | 0x8040U);
#else
    static_cast<void>(flush);
#endif
  }
  ~Environment() { std::fesetenv(&saved_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::fenv_t saved_;
};

/// What a function must leave as found: everything but the sticky exception flags.
inline unsigned control_bits() {
#if defined(__SSE2__)
  return _mm_getcsr() & 0xffc0U;
#else
  return static_cast<unsigned>(std::fegetround());
#endif
}

}  // namespace hcsp::oracle
