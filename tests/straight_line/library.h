// SPDX-License-Identifier: Apache-2.0
// The shipped models, compiled once, as something that answers moves.
#pragma once

#include "lang/online.h"
#include "tests/straight_line/answer.h"

namespace hcsp::straight_line {

class Library {
 public:
  explicit Library(int type, std::size_t joints = 7);
  /// The answer to a move of this type.
  Answer solve(const Move& move);
  /// Of the last answer, if it was solved: the state of the reference joint's coordinate and the position of
  /// every joint at an instant, in doubles.
  [[nodiscard]] State state_at(double time) const;
  [[nodiscard]] double jerk_at(double time) const;  ///< of types VI to IX
  [[nodiscard]] Vector positions_at(double time) const;
  [[nodiscard]] CompiledProblem& compiled() { return problem_; }

 private:
  [[nodiscard]] Span span(const char* name) const;
  [[nodiscard]] double value_at(const char* tube, std::size_t joint, double time) const;
  void read(Answer& answer) const;

  int type_;
  std::size_t joints_, reference_ = 0;
  CompiledProblem problem_;
};

}  // namespace hcsp::straight_line
