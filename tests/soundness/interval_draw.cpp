// SPDX-License-Identifier: Apache-2.0
#include "tests/soundness/interval_draw.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hcsp::campaign {

namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kHalfPi = 0x1.921fb54442d18p+0;

double finite(double x) { return std::clamp(x, -kLargest, kLargest); }

}  // namespace

double step(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, kInfinity);
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -kInfinity);
  return x;
}

double Draw::signed_power(double lowest, double highest) {
  const double x = std::ldexp(within(1.0, 2.0), static_cast<int>(within(lowest, highest)));
  return below(2) == 0 ? x : -x;
}

double Draw::corner(std::size_t kind) {
  const double sign = below(2) == 0 ? 1.0 : -1.0;
  const int ulps = static_cast<int>(below(5)) - 2;
  switch (kind) {
    case 0:
      return sign * std::bit_cast<double>(bits() >> (12 + below(52)));  // subnormal
    case 1:
      return signed_power(1000, 1024);
    case 2:
      return signed_power(-1060, -1000);
    case 3:
      return 0.5 * (static_cast<double>(below(201)) - 100.0);
    case 4:
      return step(sign * std::ldexp(1.0, static_cast<int>(below(2098)) - 1074), ulps);
    case 5:
      return step(sign * kHalfPi * static_cast<double>(below(64)), ulps);
    case 6:  // about multiples of pi/2 that no longer fit in a few bits
      return step(sign * kHalfPi * std::floor(std::exp2(within(0, 50))), ulps);
    case 7:
      return below(2) == 0 ? sign * kLargest : sign * std::numeric_limits<double>::denorm_min();
    default:
      return sign * (1.0 + signed_power(-52, -1));
  }
}

double Draw::number(const Focus& focus) {
  const std::size_t kind = below(30);
  if (kind < 10) return within(focus.lo, focus.hi);
  if (kind < 13 && !focus.points.empty()) {
    return finite(step(focus.points[below(focus.points.size())], static_cast<int>(below(7)) - 3));
  }
  if (kind < 17) return signed_power(-60, 60);
  if (kind < 20) {
    const double x = std::bit_cast<double>(bits());
    return std::isfinite(x) ? x : 0.0;
  }
  return finite(corner(kind - 20));
}

Pool::Pool(std::size_t size, const Focus& focus, Draw& draw) : zero_(0) {
  numbers_ = {-kInfinity, 0.0, kInfinity};
  while (numbers_.size() < size) {
    numbers_.push_back(draw.number(focus));
    // A neighbour, for boxes one ulp wide.
    if (draw.below(4) == 0) numbers_.push_back(finite(step(numbers_.back(), 1)));
  }
  std::sort(numbers_.begin(), numbers_.end());
  numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
  zero_ =
      static_cast<std::size_t>(std::lower_bound(numbers_.begin(), numbers_.end(), 0.0) - numbers_.begin());
  numbers_[zero_] = 0.0;
}

Interval Pool::interval(const Span& s) const {
  if (s.is_empty()) return Interval::empty();
  const double zero = (s.first + s.last) % 2 == 0 ? 0.0 : -0.0;
  return Interval::raw(s.first == zero_ ? zero : numbers_[s.first],
                       s.last == zero_ ? zero : numbers_[s.last]);
}

std::size_t Pool::pick(const Span& s, std::size_t size, Draw& draw) {
  const std::size_t k = s.first + draw.below(s.last - s.first + 1);
  return std::clamp(k, std::size_t{1}, size - 2);
}

Span Pool::span(Draw& draw) const {
  const std::size_t n = numbers_.size();
  const std::size_t a = 1 + draw.below(n - 2), b = 1 + draw.below(n - 2);
  switch (draw.below(16)) {
    case 0:
    case 1:
      return {a, a};
    case 2:
      return {0, a};
    case 3:
      return {a, n - 1};
    case 4:
      if (draw.below(8) == 0) return {};
      return draw.below(8) == 0 ? Span{0, n - 1} : Span{std::min(a, zero_), std::max(a, zero_)};
    case 5:
    case 6:
      return {a, a + 1};
    case 7:
    case 8:
    case 9:
      return {a, std::min(a + draw.below(64), n - 1)};
    default:
      return {std::min(a, b), std::max(a, b)};
  }
}

}  // namespace hcsp::campaign
