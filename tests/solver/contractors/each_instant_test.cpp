// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "solver/problem.h"

namespace hcsp {
namespace {

struct EachInstant : ::testing::Test {
  EachInstant() { problem.set_time_line(TimeLine({0, 1, 2})); }

  // What is at least c, or at most -c, of a tube.
  std::function<void()> apart(TubeVariable x, double c) {
    return [this, x, c] {
      problem.constrain_at_least("far", 1,
                                 {[=, this] { problem.constrain("up", problem(x)[0] >= Interval(c)); },
                                  [=, this] { problem.constrain("down", problem(x)[0] <= Interval(-c)); }});
    };
  }

  Problem problem{"each instant"};
};

TEST_F(EachInstant, ChoosesAnew) {
  Tube domain(problem.time_line(), 1);
  for (std::size_t item = 0; item < 5; ++item) domain.set(0, item, Interval(-4, 4));
  domain.set(0, 0, Interval(-4, 1));
  domain.set(0, 3, Interval(0, 4));
  domain.set(0, 4, Interval(-1, 1));
  const auto x = problem.tube("x", domain);
  problem.during(Window{0, 1}, [&] { problem.at_each_instant("c", apart(x, 2)); });
  problem.during(Window{1, 2}, [&] { problem.at_each_instant("c2", apart(x, 0.5)); });
  const Result result = problem.propagate();
  const Tube& left = std::get<Tube>(result["x"]);
  EXPECT_EQ(left.at(0, 0), Interval(-4, -2));
  EXPECT_EQ(left.at(0, 1), Interval(-4, 4));
  EXPECT_EQ(left.at(0, 2), Interval(-4, 4));
  EXPECT_EQ(left.at(0, 3), Interval(0.5, 4));
  EXPECT_EQ(left.at(0, 4), Interval(-1, 1));
}

// Over a slice the tube may take one way here and the other there.
TEST_F(EachInstant, MixesWaysWithinASlice) {
  const auto x = problem.tube("x", 1);
  const auto s = problem.real("s", {0, 4});
  problem.at_each_instant("c", [&] {
    problem.constrain_at_least(
        "way", 1,
        {[&] { problem.constrain("a", problem(x)[0] == Interval(0.0) && problem(s) >= Interval(1.0)); },
         [&] { problem.constrain("b", problem(x)[0] == Interval(3.0) && problem(s) <= Interval(2.0)); }});
  });
  const Result result = problem.propagate();
  EXPECT_EQ(std::get<Interval>(result["s"]), Interval(0, 4));
  for (std::size_t item = 0; item < 5; ++item)
    EXPECT_EQ(std::get<Tube>(result["x"]).at(0, item), Interval(0, 3));
}

TEST_F(EachInstant, HasUnknownsOfItsOwn) {
  Tube domain(problem.time_line(), 1);
  for (std::size_t item = 0; item < 5; ++item) domain.set(0, item, Interval(static_cast<double>(item)));
  const auto x = problem.tube("x", domain);
  const auto y = problem.tube("y", 1);
  problem.at_each_instant("c", [&] {
    const Expr twice = problem(problem.real("twice"));
    problem.constrain("a", twice == problem(x)[0] * Interval(2.0));
    problem.constrain("b", problem(y)[0] == twice);
  });
  const Result result = problem.propagate();
  for (std::size_t item = 0; item < 5; ++item)
    EXPECT_EQ(std::get<Tube>(result["y"]).at(0, item), Interval(2.0 * static_cast<double>(item)));
}

// A given instant and a moment ago are the same whichever way is taken.
TEST_F(EachInstant, SpeaksOfGivenInstantsAndDelays) {
  const auto x = problem.tube("x", 1);
  problem.at_each_instant("c", [&] {
    problem.constrain("a", problem(x)[0] >= problem.at(x, 0.0)[0] + problem.time());
    problem.constrain("b", problem.delayed(x, 1.0)[0] <= Interval(5.0));
  });
  problem.constrain("start", problem.at(x, 0.0)[0] == Interval(3.0));
  const Result result = problem.propagate();
  const Tube& left = std::get<Tube>(result["x"]);
  EXPECT_EQ(left.at(0, 0), Interval(3.0));
  EXPECT_EQ(left.at(0, 2), Interval(4, 5));
  EXPECT_EQ(left.at(0, 4), Interval(5, kInfinity));
}

TEST_F(EachInstant, NamesTheInstantThatHasNoSolution) {
  Tube domain(problem.time_line(), 1);
  domain.set(0, 3, Interval(-1, 1));
  const auto x = problem.tube("x", domain);
  problem.at_each_instant("c", apart(x, 2));
  const Result result = problem.propagate();
  ASSERT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.explanation->constraint, "c");
  EXPECT_EQ(result.explanation->time, (std::array<double, 2>{1, 2}));
}

TEST_F(EachInstant, RefusesWhatSpeaksOfMore) {
  const auto x = problem.tube("x", 1);
  const auto s = problem.real("s", {0, 2});
  const auto refused = [&](const std::function<void()>& body) {
    EXPECT_THROW(problem.at_each_instant("c", body), std::invalid_argument);
  };
  refused([&] { problem.constrain_derivative("d", x, {problem.constant(1.0)}); });
  refused([&] { problem.at(x, problem(s)); });
  refused([&] { problem.integral(problem(x), 0.0); });
  refused([&] { problem.constrain_sometime("s", problem(x)[0] > Interval(0.0)); });
  refused([&] { problem.during(Window{0, 1}, [] {}); });
  refused([&] { problem.at_each_instant("again", [] {}); });
  EXPECT_FALSE(problem.is_at_each_instant());
}

// A derivative, too, may be known over a part of the time.
TEST_F(EachInstant, DerivativesHaveWindows) {
  const auto x = problem.tube("x", 1);
  problem.constrain("start", problem.at(x, 0.0)[0] == Interval(0.0));
  problem.during(Window{0, 1}, [&] { problem.constrain_derivative("d", x, {problem.constant(2.0)}); });
  const Result result = problem.propagate();
  const Tube& left = std::get<Tube>(result["x"]);
  EXPECT_EQ(left.at(0, 2), Interval(2.0));
  EXPECT_TRUE(left.at(0, 3).is_entire());
}

}  // namespace
}  // namespace hcsp
