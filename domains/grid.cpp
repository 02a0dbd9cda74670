// SPDX-License-Identifier: Apache-2.0
#include "domains/grid.h"

#include <algorithm>
#include <cmath>

#include "domains/check.h"

namespace hcsp {

Grid::Grid(std::size_t dim, double precision)
    : dim_(dim), precision_(precision), significand_(0), exponent_(0) {
  require(dim >= 1 && dim <= 3, "Grid: a set lives in 1 to 3 dimensions, not {}", dim);
  require(std::isnormal(precision) && precision > 0, "Grid: the precision {} is not positive", precision);
  significand_ = static_cast<std::uint64_t>(std::ldexp(std::frexp(precision, &exponent_), 53));
  exponent_ -= 53;
  require(std::isfinite(std::ldexp(precision, 32)), "Grid: the precision {} is too large", precision);
  lines_.reserve(2 * kTabulated + 1);
  for (std::int64_t i = -kTabulated; i <= kTabulated; ++i) lines_.push_back(exact_line(i));
}

// Integer arithmetic: the product has at most 85 bits, so it is exact, and it is rounded to nearest, ties to
// even, by hand; the rounding mode of the thread plays no part.
double Grid::exact_line(std::int64_t i) const {
  const bool negative = i < 0;
  unsigned __int128 product =
      static_cast<unsigned __int128>(significand_) * static_cast<std::uint64_t>(negative ? -i : i);
  int exponent = exponent_;
  int excess = 0;
  for (unsigned __int128 rest = product >> 53; rest != 0; rest >>= 1) ++excess;
  if (excess > 0) {
    const unsigned __int128 half = static_cast<unsigned __int128>(1) << (excess - 1);
    const unsigned __int128 below = product & ((half << 1) - 1);
    product >>= excess;
    if (below > half || (below == half && (product & 1) != 0)) ++product;
    exponent += excess;
  }
  const double magnitude = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(product)), exponent);
  return negative ? -magnitude : magnitude;
}

std::int64_t Grid::cell_of(double x) const {
  const double guess = std::floor(x / precision_);
  const double reach = static_cast<double>(kReach);
  auto i = static_cast<std::int64_t>(std::min(std::max(guess, -reach), reach - 1));
  while (i > -kReach && line(i) > x) --i;
  while (i < kReach - 1 && line(i + 1) <= x) ++i;
  return i;
}

}  // namespace hcsp
