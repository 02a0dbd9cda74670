// SPDX-License-Identifier: Apache-2.0
// Types VI to IX, one coordinate: which states can be stopped within the limits where the derivative of jerk
// (snap) is limited.
#pragma once

#include "tests/straight_line/move.h"

namespace hcsp::straight_line {

/// The limit of the coordinate's snap.
Number snap_on(const std::vector<Number>& rho, const Move& move);

/// Can the motion be stopped, from the state and its jerk on, without leaving the limits? By turning its
/// acceleration as fast as possible.
bool can_stop_with_snap(const State& state, const Number& jerk, const Limits& limits, const Number& snap);
/// The same backward in time.
bool can_have_started_with_snap(const State& state, const Number& jerk, const Limits& limits,
                                const Number& snap);

/// The greatest velocity of the motion that turns its acceleration as fast as possible, until it falls;
/// infinite where the turn is under way too fast already.
Number least_crest(const State& state, const Number& jerk, const Limits& limits, const Number& snap);

/// Whether velocities are so close to each other that what turns may come out on the other side: braking may
/// then be all of the first half.
bool is_narrow(const Limits& limits, const Number& snap);

}  // namespace hcsp::straight_line
