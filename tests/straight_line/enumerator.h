// SPDX-License-Identifier: Apache-2.0
// The fastest motion of one coordinate, by trying every structure: an oracle for the tests, which shares no
// code with the library and knows nothing of which structure wins.
//
// A structure is a word. `+` and `-` are phases at the greatest and the least jerk (of types I and II:
// acceleration); `A` and `a` hold the acceleration at its greatest and its least value, `V` and `v` the
// velocity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/straight_line/profile.h"

namespace hcsp::straight_line {

/// The words up to seven letters that a motion can follow and that the end conditions determine: as many
/// durations as equations, in each part between two cruises.
std::vector<std::string> words();

/// Types III to V: from (0, w0, b0) to (q1, w1, b1), both within the limits and able to stop and to have
/// started. None if no word gets there within the limits.
std::optional<Profile> fastest(const State& from, const State& to, const Limits& limits);

/// All motions that the words give, within the limits or not: what a test of the enumerator looks at.
std::vector<Profile> motions(const State& from, const State& to, const Limits& limits,
                             const std::string& word);

/// Types I and II: velocity and acceleration limits only (`b` of the states and the jerk limits are not
/// looked at); the phases' `jerk` is their acceleration. From a velocity beyond the limits the motion brakes
/// first.
std::optional<Profile> fastest_without_jerk(const State& from, const State& to, const Limits& limits);

/// The fastest motion from any state to one that is within the limits and can stop; the empty word if `from`
/// is such. An acceleration beyond its limits comes back first; braking may leave the velocity limits on the
/// side on which it is.
Profile braking(const State& from, const Limits& limits);

/// Braking, and then the fastest motion on; none if the target cannot be reached.
std::optional<Profile> fastest_from_anywhere(const State& from, const State& to, const Limits& limits);

}  // namespace hcsp::straight_line
