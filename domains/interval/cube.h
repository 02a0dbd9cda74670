// SPDX-License-Identifier: Apache-2.0
// x^3 rounded upward, for one bound or several at once. For source files only. PRECONDITION: the thread
// rounds upward (kernel.h).
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace hcsp::up {

/// The least double not below x^3, or NaN where this cannot tell. T is double with Word std::int64_t, or a
/// vector of them with as many words. With x = u + r, u of 26 bits, and u^2 = s = v + w, v of 26 bits, x^3 is
/// v u, exactly, and w u + s r + x r (u + x), below 2^-23 of it, in double with roundings that come to 2^-73.
/// Where r is 0 nothing but the sum is rounded; where it is not, the sums with the least and the most that
/// the rest can be must be one double.
template <class Word, class T>
inline T cube_or_nan(const T& x) {
  const auto masked = [](const T& value, std::int64_t mask) {
    return std::bit_cast<T>(std::bit_cast<Word>(value) & mask);
  };
  constexpr std::int64_t kUpperBits = ~0x7ffffffLL, kAllButSign = INT64_MAX;
  const T u = masked(x, kUpperBits), r = x - u, s = u * u, v = masked(s, kUpperBits);
  const T main = v * u, rest = (s - v) * u + s * r + x * (r * (u + x));
  const T size = masked(main, kAllButSign), error = 0x1p-71 * size;
  const auto is_sure = (r == 0.0) | (main + (rest - error) == main + (rest + error));
  const auto is_moderate = (size > 0x1p-900) & (size < 0x1p900);
  const T result = main + rest, unknown = T{} + std::numeric_limits<double>::quiet_NaN();
  return ((is_moderate & is_sure) | (x == 0.0)) ? result : unknown;
}

}  // namespace hcsp::up
