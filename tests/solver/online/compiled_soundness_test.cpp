// SPDX-License-Identifier: Apache-2.0
// Compiled problems where terms are undefined, slopes are unbounded, and nothing is left to search.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/online/compiled_problem.h"

namespace hcsp {
namespace {

Interval real_value(const CompiledProblem& compiled, const std::string& name) {
  const auto found = compiled.value(compiled.variable(name));
  return found.empty() ? Interval::empty() : found[0];
}

// y where f(p y) + y^2 == 4, for p == 0 after p == 1.
template <class F>
void solve_at_zero(F f, double at_zero) {
  Problem problem("vertical tangents");
  const Expr p = problem(problem.parameter("p", Interval(1.0)));
  const Expr y = problem(problem.real("y", Interval(0.0, 3.0)));
  problem.constrain("sum", f(p * y) + sqr(y) == Interval(4.0));
  CompiledProblem compiled = compile(problem, y);
  compiled.solve();
  ASSERT_TRUE(compiled.set(compiled.parameter("p"), 0.0));
  for (const bool is_warm : {true, false}) {
    if (!is_warm) compiled.forget();
    EXPECT_EQ(compiled.solve(), OnlineStatus::solved);
    EXPECT_LE(compiled.objective().lo(), at_zero);
    EXPECT_GE(compiled.objective().hi(), at_zero);
    EXPECT_LT(compiled.objective().width(), 1e-9);
  }
}

TEST(CompiledSoundness, SlopesWithoutAnyValueTellNothing) {
  solve_at_zero([](Expr a) { return sqrt(a); }, 2.0);
  solve_at_zero([](Expr a) { return root(a, 3); }, 2.0);
  solve_at_zero([](Expr a) { return pow(a, Expr(a.dag(), a.dag().constant(Interval(0.5)))); }, 2.0);
  solve_at_zero([](Expr a) { return asin(Interval(1.0) - a) - acos(Interval(1.0) - a); },
                std::sqrt(4.0 - std::acos(-1.0) / 2.0));
}

TEST(CompiledSoundness, NotOfWhatIsUndefinedIsTrue) {
  Problem problem("negation");
  const Expr x = problem(problem.real("x", Interval(-1.0, 1.0)));
  problem.constrain("negated", !(sqrt(x) >= Interval(0.0)));
  CompiledProblem compiled = compile(problem, x);
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  EXPECT_TRUE(compiled.objective().contains(-1.0));
}

TEST(CompiledSoundness, ChoicesByWhatIsUndefinedTakeTheOther) {
  Problem problem("choice");
  const Expr x = problem(problem.real("x", Interval(-1.0, 1.0)));
  const Expr z = problem(problem.real("z", Interval(-5.0, 5.0)));
  const auto number = [&](double value) { return problem.constant(Interval(value)); };
  problem.constrain("choice", z == if_then_else(sqrt(x) >= Interval(0.0), number(1.0), number(-2.0)));
  problem.constrain("low", z <= Interval(0.0));
  CompiledProblem compiled = compile(problem, z);
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  EXPECT_TRUE(compiled.objective().contains(-2.0));
}

// 0 sqrt(y) is not 0 for y < 0.
TEST(CompiledSoundness, WhatIsMultipliedByZeroStillHasToBeDefined) {
  Problem problem("product");
  const Expr x = problem(problem.real("x", Interval(-1.0, 1.0)));
  const Expr y = problem(problem.real("y", Interval(-1.0, 1.0)));
  problem.constrain("zero", x == Interval(0.0));
  problem.constrain("negated", !(x * sqrt(y) >= Interval(0.0)));
  CompiledProblem compiled = compile(problem, y);
  EXPECT_NE(compiled.solve(), OnlineStatus::infeasible);
  if (compiled.has_solution()) {
    EXPECT_LE(compiled.objective().lo(), -1.0);
  }
}

// x is known from the first, y in each case.
TEST(CompiledSoundness, WhatWasDroppedKnowsWhatBecomesKnown) {
  Problem problem("dropped before");
  const Expr p = problem(problem.parameter("p", Interval(1.0)));
  const Expr x = problem(problem.real("x", Interval(-1.0, 1.0)));
  const Expr y = problem(problem.real("y", Interval(-9.0, 9.0)));
  const Expr z = problem(problem.real("z", Interval(-9.0, 9.0)));
  problem.constrain("zero", x == Interval(0.0));
  problem.constrain("either",
                    (y == p && z >= Interval(1.0)) || (y == p - Interval(4.0) && z >= Interval(0.5)));
  problem.constrain("product", x * sqrt(y) <= z);
  CompiledProblem compiled = compile(problem, z);
  for (const auto& [value, least] : {std::pair(1.0, 1.0), {5.0, 0.5}, {-1.0, 9.5}}) {
    ASSERT_TRUE(compiled.set(compiled.parameter("p"), value));
    compiled.solve();
    if (compiled.has_solution()) {
      EXPECT_GE(compiled.objective().hi(), least) << value;
      EXPECT_GE(real_value(compiled, "y").hi(), 0.0);
    }
  }
}

// Where the factor by which y is eliminated is 0, y may be anything.
TEST(CompiledSoundness, QuotientsByZeroRefuteNothing) {
  Problem problem("factor");
  const Expr p = problem(problem.parameter("p", Interval(2.0)));
  const Expr q = problem(problem.parameter("q", Interval(2.0)));
  const Expr n = problem(problem.integer("n", Interval(0.0, 1.0)));
  const Expr y = problem(problem.real("y", Interval(-4.0, 4.0)));
  problem.constrain("product", (n - p) * y == q);
  problem.constrain("low", p <= Interval(3.0));
  CompiledProblem compiled = compile(problem, y);
  EXPECT_EQ(compiled.solve(), OnlineStatus::solved);
  EXPECT_TRUE(compiled.objective().contains(-2.0));
  compiled.set(compiled.parameter("p"), 1.0);
  compiled.set(compiled.parameter("q"), 0.0);
  EXPECT_NE(compiled.solve(), OnlineStatus::infeasible);
  if (compiled.has_solution()) {
    EXPECT_LE(compiled.objective().lo(), -4.0);
  }
  compiled.set(compiled.parameter("p"), 4.0);
  EXPECT_EQ(compiled.solve(), OnlineStatus::infeasible);
}

// The slope 2 x of x^2 is a value that the inequality has, which is evaluated later than the equation.
TEST(CompiledSoundness, SlopesAreOfTheBoxAtHand) {
  Problem problem("slopes");
  const Expr p = problem(problem.parameter("p", Interval(2.25)));
  const Expr x = problem(problem.real("x", Interval(0.0, 4.0)));
  const Expr two = problem.constant(Interval(2.0));
  problem.constrain("kinked", p == sqr(x) + x - max(p, x) * x && two * x < sqr(x));
  CompiledProblem compiled = compile(problem, sqrt(sqr(x)));
  for (const double value : {2.25, 2.5, 3.0, 2.125}) {
    ASSERT_TRUE(compiled.set(compiled.parameter("p"), value));
    ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
    EXPECT_TRUE(real_value(compiled, "x").contains(value)) << value;
    EXPECT_TRUE(compiled.objective().contains(value)) << value;
  }
}

TEST(CompiledSoundness, NothingNeedBeLeftToSearch) {
  Problem problem("no case");
  const Expr x = problem(problem.real("x", Interval(-1.0, 1.0)));
  problem.constrain("wide", x >= Interval(-3.0));
  problem.constrain("high", x >= Interval(3.0));
  CompiledProblem compiled = compile(problem, x);
  EXPECT_EQ(compiled.solve(), OnlineStatus::infeasible);
  EXPECT_EQ(compiled.reason(), "high");
}

TEST(CompiledSoundness, WholeNumbersAreDoubles) {
  Problem problem("far out");
  const Expr n = problem(problem.integer("n", Interval(0x1p53, 0x1p53 + 4.0)));
  const Expr x = problem(problem.real("x"));
  problem.constrain("next", x == n - Interval(0x1p53) && x >= Interval(0.5));
  EXPECT_THROW(compile(problem, x), std::invalid_argument);
}

TEST(CompiledSoundness, APartOfAVectorDoesNotMakeItValid) {
  Problem problem("vector");
  const VectorExpr p = problem(problem.parameter_vector("p", Box{Interval(0.0), Interval(0.0)}));
  const Expr x = problem(problem.real("x", Interval(-9.0, 9.0)));
  problem.constrain("sum", x == p[0] + p[1]);
  CompiledProblem compiled = compile(problem, x);
  const std::array bad{1.0, std::nan("")}, good{1.0, 2.0};
  EXPECT_FALSE(compiled.set(compiled.parameter("p"), std::span<const double>(bad)));
  EXPECT_TRUE(compiled.set(compiled.parameter("p[1]"), 1.0));
  EXPECT_EQ(compiled.solve(), OnlineStatus::invalid);
  EXPECT_FALSE(compiled.set(compiled.parameter("p[2]"), std::nan("")));
  EXPECT_TRUE(compiled.set(compiled.parameter("p"), std::span<const double>(good)));
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  EXPECT_TRUE(real_value(compiled, "x") == Interval(3.0));
}

// A definition, too, is false where what it equates is undefined.
TEST(CompiledSoundness, DefinitionsOfTubesAreDefined) {
  for (const bool is_start : {true, false}) {
    Problem problem("tube");
    const Expr end = problem(problem.real("T", Interval(1.0, 2.0)));
    const Expr y = problem(problem.real("y", Interval(-1.0, 1.0)));
    problem.set_phases(end, {end});
    const TubeVariable x = problem.tube("x", 1);
    const Expr zero = problem.constant(Interval(0.0));
    problem.constrain_derivative("motion", x, {is_start ? zero : log(y + Interval(1.0))});
    problem.constrain("start", problem.at(x, 0.0)[0] == (is_start ? sqrt(y) : zero));
    const double least = is_start ? 0.0 : -1.0;
    CompiledProblem compiled = compile(problem, y);
    EXPECT_NE(compiled.solve(), OnlineStatus::infeasible);
    if (compiled.has_solution()) {
      EXPECT_GE(compiled.objective().hi(), least);
      EXPECT_GE(real_value(compiled, "y").lo(), least);
    }
    const Result general = problem.minimize(y);
    EXPECT_GE(general.objective->hi(), least);
  }
}

}  // namespace
}  // namespace hcsp
