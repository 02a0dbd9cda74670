// SPDX-License-Identifier: Apache-2.0
// Corners that random problems met once: small problems that show each alone.
#include <gtest/gtest.h>

#include "solver/problem.h"

namespace hcsp::soundness {

// Cells that each support a half-line: the hull is that of all of them, wherever the search begins. Here a1 -
// x < a2 with a in [-4, 4.5)^2, so that every x above -8.5 has a support, and none below.
TEST(Corners, SupportsThatAreHalfLines) {
  Problem problem("half-lines");
  const auto x = problem.real("x");
  const auto map = problem.set("M", 2, 0.5, Box{{-4, 4}, {-4, 4}});
  const VectorExpr a = problem.point(2);
  problem.constrain_meets("hit", {2, a[0] - problem(x) < a[1]}, map);
  const Result result = problem.propagate();
  ASSERT_EQ(result.status, Status::contracted);
  EXPECT_EQ(std::get<Interval>(result["x"]), Interval::raw(-8.5, kInfinity));
}

// D has a bound, and the tree behind it may have grown beyond it or not: what is outside counts all the same.
// The zone is near 0 for x < 0 and near 500 otherwise, where nothing of D is; "wide" only makes the tree
// grow.
TEST(Corners, WhatIsOutsideABoundDoesNotDependOnTheTree) {
  for (const Order order : {Order::declared, Order::reversed}) {
    for (const bool wide : {false, true}) {
      Problem problem("far outside");
      problem.set_time_line(TimeLine({0, 1}));
      const auto line = problem.time_line();
      const auto x = problem.real("x", {-5, 5}), y = problem.real("y", {-1, 1}),
                 v = problem.real("v", {0, 5});
      const auto z = problem.tube("z", sampled(line, {0, 1}, {Box{0.5}, Box{0.5}}));
      problem.set_readings(z, {{0, ""}, {1, ""}});
      const auto dug = problem.set("D", 1, 0.125, Box{{-1, 1}});
      const Expr a = problem.point(1)[0], zero = problem.constant(0), far = problem.constant(500);
      const auto place = [&](RealVariable s, Expr negative, Expr other) {
        return if_then_else(problem(s) < Interval(0.0), negative, other);
      };
      problem.constrain_union("one", dug, {1, abs(a - place(x, zero, far)) < problem(z)[0]});
      if (wide) {
        problem.constrain_union("wide", dug, {1, abs(a - place(y, far, zero)) < problem(z)[0] - problem(v)});
      }
      PropagationOptions options;
      options.order = order;
      const Result result = problem.propagate(options);
      ASSERT_EQ(result.status, Status::contracted);
      EXPECT_EQ(std::get<Interval>(result["x"]), Interval(-5, 0)) << "wide " << wide;
    }
  }
}

// A face that the space beyond the tree supported has lost its support when that space is ruled out, even
// where cells that were tried as guesses are still there.
TEST(Corners, SpaceBeyondTheTreeIsRuledOut) {
  for (const Order order : {Order::declared, Order::reversed}) {
    Problem problem("beyond");
    problem.set_time_line(TimeLine({0, 1}));
    Tube domain(problem.time_line(), 1);
    domain.set(0, 0, {-1, 1});
    domain.set(0, 1, {-1, 1});
    domain.set(0, 2, {-1000, 1000});
    const auto x = problem.tube("x", domain);
    const auto map = problem.set("M", 1, 0.125);
    const Expr a = problem.point(1)[0];
    problem.constrain_meets("hit", {1, a == problem(x)[0]}, map);
    problem.constrain_union("small", map, {1, abs(a) <= Interval(3.0)});
    PropagationOptions options;
    options.order = order;
    const Result result = problem.propagate(options);
    ASSERT_EQ(result.status, Status::contracted);
    EXPECT_EQ(std::get<Tube>(result["x"]).gate(0, 1), Interval(-3, 3.125));
  }
}

}  // namespace hcsp::soundness
