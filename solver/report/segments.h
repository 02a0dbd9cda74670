// SPDX-License-Identifier: Apache-2.0
// The motion polynomials of a result on a time line with phases (Kröger 2011, equations 1 to 4): for every
// segment, which is a phase, and every joint, which is a component of the tubes, the time interval and the
// polynomials of all tubes there. Coefficient i belongs to (t - start of the segment)^i. They are those of
// the first solution that is proven to exist, or else what holds of all.
#pragma once

#include <string>

#include "solver/report/text.h"
#include "solver/result.h"

namespace hcsp::report {

/// Whether the result has tubes on phases.
bool has_segments(const Result& result);

/// The list that is called "segments" in the result file. Numbers are the middles of what is known: those of
/// "interval" fit together. "enclosure" and the coefficients have bounds.
void put_segments(TextBuffer& out, const Result& result);

/// A row a segment and joint: segment,joint,start,end, then p0,p1,p2,... for each tube p, all numbers to
/// execute, then the bounds of all these numbers.
std::string segments_csv(const Result& result);

}  // namespace hcsp::report
