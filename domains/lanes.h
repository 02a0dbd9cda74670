// SPDX-License-Identifier: Apache-2.0
// Comparisons of eight sums at once, as bits: the inner loop of painting. Sums round as the thread does.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace hcsp {

/// Bit i: row[i] + shift <= limit.
inline std::uint64_t sums_at_most(const double* row, double shift, double limit) {
  std::uint64_t bits = 0;
#if defined(__SSE2__)
  const __m128d shifts = _mm_set1_pd(shift), limits = _mm_set1_pd(limit);
  for (int pair = 0; pair < 4; ++pair) {
    const __m128d sums = _mm_add_pd(_mm_loadu_pd(row + 2 * pair), shifts);
    bits |= static_cast<std::uint64_t>(_mm_movemask_pd(_mm_cmple_pd(sums, limits))) << (2 * pair);
  }
#else
  for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(row[i] + shift <= limit) << i;
#endif
  return bits;
}

}  // namespace hcsp
