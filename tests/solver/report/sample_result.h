// SPDX-License-Identifier: Apache-2.0
// A small result that has a variable of every kind, infinite bounds, and passes.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "domains/set_descent.h"
#include "solver/report/presentation.h"
#include "solver/result.h"

namespace hcsp::sample {

/// Settles the cells of a square, lo <= index < hi on both axes.
struct SquareZone {
  std::int64_t lo, hi;
  [[nodiscard]] Decision decide(const Region& cells) const {
    const auto is_within = [&](std::size_t axis) { return lo <= cells.lo[axis] && cells.hi[axis] <= hi; };
    const auto is_apart = [&](std::size_t axis) { return cells.hi[axis] <= lo || hi <= cells.lo[axis]; };
    if (is_within(0) && is_within(1)) return Decision::all;
    return is_apart(0) || is_apart(1) ? Decision::none : Decision::split;
  }
};

inline Region square(std::int64_t lo, std::int64_t hi) {
  Region region;
  region.lo = {lo, lo, 0};
  region.hi = {hi, hi, 1};
  return region;
}

/// Cells of edge 0.5 in [-1, 1]^2; those of [0, 1]^2 are inside.
inline SetInterval bounded_set() {
  SetInterval set(2, 0.5, Box{Interval(-0.99, 0.99), Interval(-0.99, 0.99)});
  SquareZone zone{0, 2};
  set.include(square(0, 2), zone);
  return set;
}

/// No upper bound; the cells of [0, 1]^2 are inside.
inline SetInterval unbounded_set() {
  SetInterval set(2, 0.5);
  SquareZone zone{0, 2};
  set.include(square(0, 2), zone);
  return set;
}

inline Tube path(const std::shared_ptr<const TimeLine>& line, double half_width) {
  Tube x(line, 2);
  for (std::size_t item = 0; item < x.items(); ++item) {
    const double t = 0.5 * static_cast<double>(item) * 0.1;
    x.set(0, item, Interval(t - half_width, t + half_width));
    x.set(1, item, Interval(-t - half_width, -t + half_width));
  }
  return x;
}

inline Result result() {
  const auto line = std::make_shared<const TimeLine>(std::vector<double>{0.0, 0.1, 0.25, 1.0});
  Tube z(line, 1);
  z.set(0, 2, Interval(1.5, 1.75));
  Result result;
  result.model = "sample";
  result.variables = {{"T", Interval(0.1, kInfinity)},
                      {"v", Box{Interval(-1.0, 2.0), Interval(-kInfinity, 1e300)}},
                      {"x", path(line, 0.125)},
                      {"z", z},
                      {"M", bounded_set()},
                      {"D", unbounded_set()},
                      {"nothing", Interval::empty()}};
  result.statistics = {0.25, 2, 1, {{"evolution", 3, 0.125}, {"impact", 4, 0.0625}}};
  result.snapshots = {
      {0,
       {{"x", Tube(line, 2)}, {"M", SetInterval(2, 0.5, Box{Interval(-0.99, 0.99), Interval(-0.99, 0.99)})}}},
      {1, {{"x", path(line, 0.5)}, {"M", bounded_set()}}}};
  return result;
}

/// Names that end elements, strings and lines where they are not escaped, and bytes that are not UTF-8.
inline const std::string kHostile = "</script><b a='1'>\"\\&\n\t\x01\xff";

}  // namespace hcsp::sample
