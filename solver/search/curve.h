// SPDX-License-Identifier: Apache-2.0
// Operations of one operand as curves: their values, slopes and the way they bend, for lines and chords that
// enclose them.
#pragma once

#include "solver/expression/dag.h"

namespace hcsp {

/// A function of one operand: that of an instruction whose other operand, if it has one, is constant.
/// PRECONDITION: the thread rounds upward.
struct Curve {
  Op op;
  Interval constant;  ///< the other operand: an exponent, or a numerator

  [[nodiscard]] Interval value(const Interval& x) const;
  [[nodiscard]] Interval slope(const Interval& x) const;
  /// An interval that holds a number of the sign of the second derivative, or of 0, for every x.
  [[nodiscard]] Interval bend(const Interval& x) const;
};

/// Whether an operation is a curve once all operands but one are constants.
bool is_curve(Op op);

}  // namespace hcsp
