// SPDX-License-Identifier: Apache-2.0
// A small problem with nothing of a motion in it: the point nearest to a goal that is on two circles, and on
// one side of a line. For tests and benchmarks of compiled problems.
#pragma once

#include <array>

#include "solver/online/compiled_problem.h"

namespace hcsp::oracle {

class TwoCircles {
 public:
  /// Centres (0, 0) and (c, 0), radii, and the line a x + b y <= 1.
  static constexpr std::array kNames = {"r", "c", "s", "a", "b"};
  using Numbers = std::array<double, kNames.size()>;

  explicit TwoCircles(const Numbers& numbers = {2.0, 3.0, 2.0, 0.1, 0.1}) : problem("two circles") {
    std::vector<Expr> given;
    for (std::size_t i = 0; i < kNames.size(); ++i)
      given.push_back(problem(problem.parameter(kNames[i], Interval(numbers[i]))));
    const Expr x = problem(problem.real("x", Interval(-100.0, 100.0)));
    const Expr y = problem(problem.real("y", Interval(-100.0, 100.0)));
    problem.constrain("first circle", sqr(x) + sqr(y) == sqr(given[0]));
    problem.constrain("second circle", sqr(x - given[1]) + sqr(y) == sqr(given[2]));
    problem.constrain("line", given[3] * x + given[4] * y <= problem.constant(Interval(1.0)));
    objective.push_back(sqr(x - problem.constant(Interval(1.0))) + sqr(y - problem.constant(Interval(5.0))));
  }
  CompiledProblem compiled() { return compile(problem, objective[0]); }

  Problem problem;
  std::vector<Expr> objective;  // one
};

}  // namespace hcsp::oracle
