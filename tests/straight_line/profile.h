// SPDX-License-Identifier: Apache-2.0
// Motions of one coordinate with piecewise constant jerk, and whether they keep to limits.
#pragma once

#include <string>
#include <vector>

#include "tests/straight_line/number.h"

namespace hcsp::straight_line {

struct State {
  Number q = 0, w = 0, b = 0;  ///< displacement, velocity, acceleration
};

/// wl <= w <= wh and so on; bl < 0 < bh and ul < 0 < uh.
struct Limits {
  Number wl, wh, bl, bh, ul, uh;
};

struct Phase {
  Number duration, jerk;
};

/// The state after a time of constant jerk.
State after(const State& state, const Number& time, const Number& jerk);

struct Profile {
  std::string word;  ///< a letter for each phase, as in enumerator.h
  std::vector<Phase> phases;

  [[nodiscard]] Number duration() const;
  [[nodiscard]] State end(State from) const;
  /// The state at an instant of the motion.
  [[nodiscard]] State at(State from, Number time) const;
  /// No duration is negative and no limit exceeded at any instant, up to negligible(scale).
  [[nodiscard]] bool keeps(const Limits& limits, State from, const Number& scale) const;
};

/// The mirror image: every sign changed.
State mirrored(const State& state);
Limits mirrored(const Limits& limits);

/// Can the motion stop (from `state` on) without leaving the limits, and has it been able to start, backward
/// in time? That is: b within its limits, w too, and w where b would be brought to 0 as fast as the jerk
/// allows; up to what is negligible beside the limits.
bool can_stop(const State& state, const Limits& limits);
bool can_have_started(const State& state, const Limits& limits);

}  // namespace hcsp::straight_line
