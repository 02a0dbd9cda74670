// SPDX-License-Identifier: Apache-2.0
// What the library says of a move, in plain numbers, and whether that can be true.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/straight_line/move.h"

namespace hcsp::straight_line {

struct Span {
  double lo = 0, hi = 0;
  [[nodiscard]] double middle() const { return lo / 2 + hi / 2; }
};

/// A phase: position, velocity, acceleration, jerk and its derivative at the start, of each joint; the last
/// of these that the type has is constant.
struct Segment {
  Span duration;
  std::vector<std::array<Span, 5>> joints;
};

struct Answer {
  std::string status, reason;
  Span bracket;  ///< of the optimum
  Span T;        ///< of the motion
  std::vector<Span> rho;
  std::vector<Segment> segments;
  std::size_t braking = 0;  ///< so many segments may be beyond the limits
};

/// What is wrong with an answer that is called solved: by arithmetic in 192 bits on intervals, from the
/// enclosures alone. Empty if they may hold an exact straight motion from the given state to the target
/// within the limits, and are as narrow as `width`, relative to the greatest number of their kind.
std::vector<std::string> faults(const Move& move, const Answer& answer, double width = 1e-8);

/// The joint that the others' ratios are to: the first whose rho may be 1, the one nearest to that if none
/// may.
std::size_t reference_of(const Answer& answer);

/// The line and the states that the middles of an answer's enclosures tell.
Line line_of(const Move& move, const Answer& answer);

/// A profile along a line as an answer, with enclosures that are as wide as a double is exact.
Answer answer_of(const Move& move, const Line& line, const Profile& profile);

}  // namespace hcsp::straight_line
