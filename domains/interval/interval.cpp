// SPDX-License-Identifier: Apache-2.0
#include "domains/interval/interval.h"

#include <fmt/format.h>

#include "domains/check.h"
#include "domains/interval/arcs.h"
#include "domains/interval/atan2.h"
#include "domains/interval/guarded.h"
#include "domains/interval/kernel.h"
#include "domains/interval/sin_cos.h"

namespace hcsp {

Interval::Interval(double x) : bounds_{-x, x} {
  require(std::isfinite(x), "Interval: a point must be finite, not {}", x);
}

Interval::Interval(double lo, double hi) : bounds_{-lo, hi} {
  require(lo <= hi && lo < kInfinity && hi > -kInfinity, "Interval: [{}, {}] is not an interval", lo, hi);
}

double Interval::width() const {
  if (is_empty()) return 0.0;
  RoundUpward guard;
  return opaque(opaque(hi()) - opaque(lo()));
}

double Interval::mid() const {
  HCSP_ASSERT(!is_empty());
  if (is_entire()) return 0.0;
  RoundNearest guard;
  const double low = opaque(lo()), high = opaque(hi());
  if (low == -kInfinity) return opaque(std::min(high, 0.0));
  if (high == kInfinity) return opaque(std::max(low, 0.0));
  // One rounding: where the sum is rounded its half is exact, and where the half is rounded the sum is exact.
  const double sum = low + high, middle = opaque(std::isinf(sum) ? 0.5 * low + 0.5 * high : 0.5 * sum);
  return opaque(std::min(std::max(middle, low), high));
}

double Interval::mag() const { return is_empty() ? 0.0 : std::max(std::abs(lo()), std::abs(hi())); }

Interval operator+(const Interval& a, const Interval& b) { return upward(up::add, a, b); }
Interval operator-(const Interval& a, const Interval& b) { return upward(up::sub, a, b); }
Interval operator*(const Interval& a, const Interval& b) { return upward(up::mul, a, b); }
Interval operator/(const Interval& a, const Interval& b) { return upward(up::div, a, b); }
Interval sqr(const Interval& a) { return upward(up::sqr, a); }
Interval sqrt(const Interval& a) { return upward(up::sqrt, a); }
Interval abs(const Interval& a) { return upward(up::abs, a); }
Interval min(const Interval& a, const Interval& b) { return upward(up::min, a, b); }
Interval max(const Interval& a, const Interval& b) { return upward(up::max, a, b); }
Interval sin(const Interval& a) { return upward(up::sin, a); }
Interval cos(const Interval& a) { return upward(up::cos, a); }
Interval atan2(const Interval& y, const Interval& x) { return upward(up::atan2, y, x); }
Interval pi() { return kPiBounds; }

std::string to_string(const Interval& a) {
  return a.is_empty() ? "[empty]" : fmt::format("[{}, {}]", a.lo(), a.hi());
}

}  // namespace hcsp
