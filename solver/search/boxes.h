// SPDX-License-Identifier: Apache-2.0
// What searches do with boxes: where a side is cut, and in which order boxes are told.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/search/mean_value.h"

namespace hcsp {

/// Where a domain is cut: in the middle, or where it is unbounded, far out.
inline double cut_of(const Interval& x) {
  constexpr double kFar = 1e8, kFarther = 1e3;
  if (x.is_bounded()) return middle_of(x);
  if (x.is_entire()) return 0.0;
  if (x.lo() == -kInfinity) return -cut_of(-x);
  return std::min(std::max(kFar, kFarther * x.lo()), std::numeric_limits<double>::max());
}

inline bool is_divisible(const Interval& x) {
  const double cut = cut_of(x);
  return x.lo() < cut && cut < x.hi();
}

/// Whether some side lost so much that less than a part of its width is left.
inline bool is_less_than(double part, const std::vector<Interval>& before, const std::vector<Interval>& now) {
  return !std::equal(now.begin(), now.end(), before.begin(), [part](const Interval& x, const Interval& was) {
    return width_of(x) >= part * width_of(was);
  });
}

/// In the order of the lower bounds, of the upper ones where those are equal.
inline bool comes_before(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](const Interval& x, const Interval& y) {
                                        return x.lo() < y.lo() || (x.lo() == y.lo() && x.hi() < y.hi());
                                      });
}

}  // namespace hcsp
