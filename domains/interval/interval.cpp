// SPDX-License-Identifier: Apache-2.0
#include "domains/interval/interval.h"

#include <fmt/format.h>

#include "domains/check.h"
#include "domains/interval/kernel.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

// Applies a kernel under upward rounding. The operands enter, and the result leaves, through opaque(), so
// that no operation can be scheduled outside the guard's lifetime.
Interval fenced(const Interval& a) { return Interval::raw(opaque(a.lo()), opaque(a.hi())); }

template <class Kernel, class... Operands>
Interval guarded(Kernel kernel, const Operands&... operands) {
  RoundUpward guard;
  return fenced(kernel(fenced(operands)...));
}

}  // namespace

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

Interval operator+(const Interval& a, const Interval& b) { return guarded(up::add, a, b); }
Interval operator-(const Interval& a, const Interval& b) { return guarded(up::sub, a, b); }
Interval operator*(const Interval& a, const Interval& b) { return guarded(up::mul, a, b); }
Interval operator/(const Interval& a, const Interval& b) { return guarded(up::div, a, b); }
Interval sqr(const Interval& a) { return guarded(up::sqr, a); }
Interval sqrt(const Interval& a) { return guarded(up::sqrt, a); }
Interval abs(const Interval& a) { return guarded(up::abs, a); }
Interval min(const Interval& a, const Interval& b) { return guarded(up::min, a, b); }
Interval max(const Interval& a, const Interval& b) { return guarded(up::max, a, b); }

std::string to_string(const Interval& a) {
  return a.is_empty() ? "[empty]" : fmt::format("[{}, {}]", a.lo(), a.hi());
}

}  // namespace hcsp
