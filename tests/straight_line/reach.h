// SPDX-License-Identifier: Apache-2.0
// How far a motion can come in a given time: docs/straight_line.md, "The greatest motion", as it stands
// there. It shares nothing with the enumerator, which it is compared with.
#pragma once

#include <optional>

#include "tests/straight_line/profile.h"

namespace hcsp::straight_line {

struct Range {
  long double least, greatest;
};

/// The displacements at time T of the motions from `from` to the velocity and the acceleration of `to`,
/// within the limits, up to rounding in long double; none if there is no such motion. Both ends have to be
/// able to stop (to have started).
std::optional<Range> reach(const State& from, const State& to, const Limits& limits, long double T);

}  // namespace hcsp::straight_line
