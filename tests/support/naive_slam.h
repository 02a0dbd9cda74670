// SPDX-License-Identifier: Apache-2.0
// Range-only SLAM solved the plain way, as a yardstick: a bitmap, loops over all cells and all samples, whole
// passes until nothing changes. No tree, no pruning, no expressions; of the library only Interval.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp::naive {

/// What was measured, as intervals that hold the truth. Row k holds from stamps[k] until stamps[k + 1];
/// ranges are known at the stamps, where they are known.
struct Log {
  std::vector<double> stamps;
  std::vector<Interval> speed, heading;
  std::vector<std::optional<Interval>> range;
};

/// The state at a sample: where the robot is, cosine and sine of its heading, how far the sensor sees.
struct Sample {
  Interval x1, x2, cosine, sine, z;
};

/// A closed cell, or a point of it.
struct Cell {
  Interval a1, a2;
};

/// What the range means: z is the least delta(a) over the points a of the map that the sensor can see.
struct Sensor {
  /// Whether every point of the cell is seen nearer than z, for every state within the sample.
  std::function<bool(const Sample&, const Cell&)> digs;
  /// One forward-backward pass of "a is seen at distance z": contracts x and z, false when nothing is left.
  std::function<bool(Sample&, const Cell&)> revise;
};

Sensor euclidean();                            ///< |a - x|
Sensor doubled();                              ///< 2 |a - x|
Sensor off_centre(double ahead, double left);  ///< |a - x - R(heading) (ahead, left)|
Sensor elliptic();                             ///< sqrt((a1 - x1)^2 + 4 (a2 - x2)^2)
Sensor cone(double half_angle);                ///< |a - x|, a within the angle to the heading

struct Solution {
  bool feasible = true;
  int passes = 0;
  std::vector<Sample> gates;                  ///< by stamp
  std::vector<std::vector<Interval>> slices;  ///< by component and slice
  std::int64_t first = 0, count = 0;          ///< cells of an axis: first, ..., first + count - 1
  std::vector<std::uint8_t> dug;              ///< by cell, row by row along the first axis
  double cell_edge = 0;

  [[nodiscard]] double mean_width() const;  ///< over the slices, of the wider component
  [[nodiscard]] double dug_area() const;    ///< D-, within the frame
  [[nodiscard]] double map_area() const;    ///< M+
  [[nodiscard]] bool is_dug(std::int64_t i1, std::int64_t i2) const;
};

/// The fixed point for a robot that starts at (0, 0) in a world of which nothing is outside the closed frame
/// [-reach, reach]^2.
Solution solve(const Log& log, const Sensor& sensor, double cell_edge, double reach = 10.0);

/// The tightest upper bound over a slice of length dt of a function that starts at most at x0, ends at most
/// at x1 and whose slope is in v.
double slice_upper(double x0, double x1, const Interval& v, const Interval& dt);

}  // namespace hcsp::naive
