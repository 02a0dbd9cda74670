// SPDX-License-Identifier: Apache-2.0
// Random moves of which it is known on what line they are.
#pragma once

#include "tests/straight_line/campaign.h"
#include "tests/straight_line/move.h"

namespace hcsp::straight_line {

enum class Kind {
  at_rest,       ///< from rest to a target as its type has it, at rest again as often as not
  moving,        ///< in motion along the line, on both ends, as far as the type has it
  near_limits,   ///< the same, states at the edge of what is admissible, limits that differ in the two
                 ///< directions
  round,         ///< numbers of few digits, so that holds and cruises of no length occur, and ties
  beyond,        ///< the start is beyond the limits
  still,         ///< some joints do not move; lines along one axis
  tiny,          ///< little or no displacement
  scaled,        ///< in other units: micrometres, hours
  overshooting,  ///< beyond limits of velocity that are close to each other, as the jerk is small
  no_peak,       ///< too near for a peak of velocity: the acceleration keeps its sign (from type III on)
  one_way        ///< some joints may move in one direction only
};
inline constexpr Kind kKinds[] = {Kind::at_rest,      Kind::moving,  Kind::near_limits, Kind::round,
                                  Kind::beyond,       Kind::still,   Kind::tiny,        Kind::scaled,
                                  Kind::overshooting, Kind::no_peak, Kind::one_way};
Kind random_kind(Draw& draw);
std::string to_string(Kind kind);

struct KnownMove {
  Move move;
  Line line;  ///< in whose vicinity, by roundings of doubles, the vectors are
};

/// A move whose target is admissible, of types 1 to 9.
KnownMove random_move(Draw& draw, int type, Kind kind, std::size_t joints = 7);

/// Moves every component of the collinear vectors by at most `by` times itself: within the tolerance if by <=
/// tol.
Move shaken(Draw& draw, const Move& move, double by);

/// One component of one vector that is not zero is off, by more than the tolerance.
Move crooked(Draw& draw, const Move& move);

/// Another target on the same line, admissible, from where the motion is: what a sensor event asks for.
KnownMove replanned(Draw& draw, const KnownMove& known, const State& now, double jerk = 0);

}  // namespace hcsp::straight_line
