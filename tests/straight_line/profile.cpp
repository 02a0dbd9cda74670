// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/profile.h"

#include <algorithm>

namespace hcsp::straight_line {

State after(const State& s, const Number& t, const Number& u) {
  return {s.q + t * (s.w + t * (s.b / 2 + t * u / 6)), s.w + t * (s.b + t * u / 2), s.b + t * u};
}

Number Profile::duration() const {
  Number sum = 0;
  for (const Phase& phase : phases) sum += phase.duration;
  return sum;
}

State Profile::end(State from) const {
  for (const Phase& phase : phases) from = after(from, phase.duration, phase.jerk);
  return from;
}

State Profile::at(State from, Number time) const {
  for (const Phase& phase : phases) {
    const Number t = std::min(time, phase.duration);
    from = after(from, t, phase.jerk);
    time -= t;
  }
  return from;
}

bool Profile::keeps(const Limits& l, State from, const Number& scale) const {
  const Number play = negligible(scale);
  const auto is_within = [&](const State& s) {
    return s.w >= l.wl - play && s.w <= l.wh + play && s.b >= l.bl - play && s.b <= l.bh + play;
  };
  if (!is_within(from)) return false;
  for (const auto& [time, jerk] : phases) {
    if (time < -play || jerk < l.ul || jerk > l.uh) return false;
    const State to = after(from, time, jerk);
    if (!is_within(to)) return false;
    // The velocity's extremum, where the acceleration changes sign.
    if ((from.b < 0) != (to.b < 0) && jerk != 0 && !is_within(after(from, -from.b / jerk, jerk)))
      return false;
    from = to;
  }
  return true;
}

State mirrored(const State& s) { return {-s.q, -s.w, -s.b}; }
Limits mirrored(const Limits& l) { return {-l.wh, -l.wl, -l.bh, -l.bl, -l.uh, -l.ul}; }

bool can_stop(const State& s, const Limits& l) {
  const Number play = negligible(l.wh - l.wl), play_of_b = negligible(l.bh - l.bl);
  if (s.b < l.bl - play_of_b || s.b > l.bh + play_of_b) return false;
  const Number stopped = s.w - s.b * s.b / (2 * (s.b > 0 ? l.ul : l.uh));
  return std::min(s.w, stopped) >= l.wl - play && std::max(s.w, stopped) <= l.wh + play;
}

bool can_have_started(const State& s, const Limits& l) {
  // Backward in time the acceleration changes its sign, and so does the velocity's derivative: w stays, b and
  // u turn over.
  return can_stop({s.q, s.w, -s.b}, {l.wl, l.wh, -l.bh, -l.bl, l.ul, l.uh});
}

}  // namespace hcsp::straight_line
