// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "solver/problem.h"

namespace hcsp {
namespace {

TEST(Alternatives, KeepWhatAtLeastSoManyOfThemLeave) {
  for (std::size_t least = 1; least <= 3; ++least) {
    Problem problem("alternatives");
    const auto x = problem.real("x", {-10, 10});
    const auto in = [&](double lo, double hi) {
      return
          [&, lo, hi] { problem.constrain("in", problem(x) >= Interval(lo) && problem(x) <= Interval(hi)); };
    };
    problem.constrain_at_least("c", least, {in(0, 3), in(2, 5), in(4, 8)});
    const Result result = problem.propagate();
    if (least == 3) {
      EXPECT_EQ(result.status, Status::infeasible);
      continue;
    }
    EXPECT_EQ(std::get<Interval>(result["x"]), least == 1 ? Interval(0, 8) : Interval(2, 5));
  }
}

// What an alternative says of a derivative, or declares, does not hold in the others.
TEST(Alternatives, KeepToThemselves) {
  Problem problem("alternatives");
  problem.set_time_line(TimeLine({0, 1, 2}));
  const auto x = problem.tube("x", 1);
  const auto s = problem.real("s", {-10, 10});
  problem.constrain("start", problem.at(x, 0.0)[0] == Interval(0.0));
  problem.constrain_at_least(
      "c", 1,
      {[&] { problem.constrain_derivative("d", x, {problem.constant(1.0)}); },
       [&] { problem.constrain("far", problem.at(x, problem(s))[0] > Interval(9.0)); }});
  const Result result = problem.propagate();
  EXPECT_TRUE(std::get<Tube>(result["x"]).at(0, 4).is_entire());
  EXPECT_EQ(std::get<Interval>(result["s"]), Interval(-10, 10));
}

// The limit of a run is that of the runs within it, also when it passes while one of several is under way.
TEST(Alternatives, EndAtTheTimeLimit) {
  Problem problem("endless");
  const auto x = problem.real("x", {-1, 1});
  const auto endless = [&] { problem.constrain("sine", problem(x) == sin(problem(x))); };
  problem.constrain_at_least("c", 1, {endless, endless, endless});
  double now = 0.0;
  PropagationOptions options;
  options.clock = [&] { return now += 0.001; };
  options.time_limit = 1.0;
  const Result result = problem.propagate(options);
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_LT(now, 1.1);
  EXPECT_TRUE(std::get<Interval>(result["x"]).contains(0.0));
}

TEST(Alternatives, RefuseACountThatCannotBe) {
  Problem problem("alternatives");
  EXPECT_THROW(problem.constrain_at_least("c", 0, {[] {}}), std::invalid_argument);
  EXPECT_THROW(problem.constrain_at_least("c", 2, {[] {}}), std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
