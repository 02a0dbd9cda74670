// SPDX-License-Identifier: Apache-2.0
// An answer's bracket against optima that the tests know.
#pragma once

#include <string>

#include "tests/straight_line/answer.h"

namespace hcsp::straight_line {

struct Comparison {
  double off = 0;    ///< how far the optimum is out of the bracket
  std::string word;  ///< of the optimum, as the enumerator writes it
};

/// Types I to V: the oracle's optimum of the line and the states that an answer tells, or of numbers that
/// differ from those as little as the enclosures are wide.
Comparison compared_with_oracle(const Move& move, const Answer& answer);

/// Types VI to IX, between states within the limits of type V: no motion takes less, for it would be one of
/// type V; 0 from and to other states...
double least_with_snap(const Line& line, const Move& move);
/// ...and with acceleration and jerk 0 at both ends one takes as much: the mean, over a time h, of a motion
/// of type V that goes on with its velocities at both ends is within all limits, and its jerk, which differs
/// by at most 2 J in that time, changes by 2 J/h at most. Infinite where that motion cannot be.
double enough_with_snap(const Line& line, const Move& move);

}  // namespace hcsp::straight_line
