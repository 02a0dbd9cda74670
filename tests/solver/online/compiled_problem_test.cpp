// SPDX-License-Identifier: Apache-2.0
#include "solver/online/compiled_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/support/environment.h"
#include "tests/support/straight_line.h"
#include "tests/support/two_circles.h"

namespace hcsp {
namespace {

using Numbers = std::vector<double>;

// A problem with parameters p, and its objective.
struct Posed {
  std::unique_ptr<Problem> problem = std::make_unique<Problem>("posed");
  std::vector<Expr> given, objective;

  explicit Posed(const Numbers& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      given.push_back((*problem)(problem->parameter(fmt::format("p{}", i), Interval(numbers[i]))));
  }
  Expr real(const std::string& name) { return (*problem)(problem->real(name, Interval(-10.0, 10.0))); }
  Expr number(double x) { return problem->constant(Interval(x)); }
};

Posed two_curves(const Numbers& numbers) {
  Posed posed(numbers);
  const Expr x = posed.real("x"), y = posed.real("y");
  posed.problem->constrain("parabola", y == posed.given[0] * sqr(x) + posed.given[1]);
  posed.problem->constrain("circle", sqr(x) + sqr(y) == posed.number(4.0));
  posed.objective.push_back(x + posed.given[2] * y);
  return posed;
}

Posed half_planes(const Numbers& numbers) {
  Posed posed(numbers);
  const Expr x = posed.real("x"), y = posed.real("y");
  posed.problem->constrain("first", posed.given[0] * x + y <= posed.number(1.0));
  posed.problem->constrain("second", x + posed.given[1] * y >= posed.number(-2.0));
  posed.problem->constrain("third", abs(x) + max(y, posed.given[2]) <= posed.number(3.0));
  posed.objective.push_back(sqr(x - posed.given[1]) + sqr(y + posed.number(1.5)));
  return posed;
}

Posed alternatives(const Numbers& numbers) {
  Posed posed(numbers);
  Problem& problem = *posed.problem;
  const Expr x = posed.real("x"), y = posed.real("y");
  const Expr flag = problem(problem.boolean("flag"));
  const Expr bent = if_then_else(flag, sqrt(x + posed.number(3.0)), min(x, posed.given[0]));
  problem.constrain("bent", y == bent);
  problem.constrain("either", x * y == posed.given[1] || (x == posed.given[2] && y >= posed.number(0.5)));
  posed.objective.push_back(abs(x) + sqr(y));
  return posed;
}

Posed by_parameters(const Numbers& numbers) {
  Posed posed(numbers);
  const Expr x = posed.real("x");
  const Expr sign = if_then_else(posed.given[0] > posed.number(0.0), posed.number(1.0), posed.number(-1.0));
  const Expr ratio = posed.given[1] / (posed.given[2] + sign * posed.number(4.0));
  posed.problem->constrain("cubic", sign * x * sqr(x) + x == ratio);
  posed.problem->constrain("side", x >= posed.given[2] - posed.number(2.0));
  posed.objective.push_back(-x);
  return posed;
}

// Where both answer they have to agree, and neither may say what the other disproves.
void compare_with_minimize(const std::function<Posed(const Numbers&)>& pose, int draws, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  Posed once = pose({0.0, 0.0, 0.0});
  CompiledProblem compiled = compile(*once.problem, once.objective[0]);
  int solved = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const Numbers numbers{uniform(random), uniform(random), draw % 5 == 0 ? 0.0 : uniform(random)};
    for (std::size_t i = 0; i < numbers.size(); ++i)
      ASSERT_TRUE(compiled.set(compiled.parameter(fmt::format("p{}", i)), numbers[i]));
    const OnlineStatus status = compiled.solve();
    Posed again = pose(numbers);
    SearchOptions options;
    options.precision = 1e-6;
    const Result expected = again.problem->minimize(again.objective[0], options);
    const std::string where = fmt::format("seed {} draw {}: {} {} {}: {} boxes, {}", seed, draw, numbers[0],
                                          numbers[1], numbers[2], compiled.boxes(), compiled.reason());
    const bool is_possible = expected.status != Status::infeasible;
    if (status == OnlineStatus::infeasible) {
      EXPECT_TRUE(expected.search->solutions.empty() ||
                  expected.search->solutions[0].certificate != Certificate::exists)
          << where;
      EXPECT_FALSE(compiled.reason().empty()) << where;
    }
    if (compiled.has_solution()) {
      EXPECT_TRUE(is_possible) << where;
      EXPECT_FALSE(meet(compiled.objective(), *expected.objective).is_empty())
          << where << to_string(compiled.objective()) << to_string(*expected.objective);
    }
    if (status == OnlineStatus::solved) {
      ++solved;
      EXPECT_LT(compiled.objective().width(), 4e-5 * std::max(1.0, compiled.objective().mag())) << where;
    }
    EXPECT_NE(status, OnlineStatus::invalid) << where;
  }
  EXPECT_GT(solved, draws / 5);
}

TEST(CompiledProblem, AgreesWithMinimizeOnTwoCurves) { compare_with_minimize(two_curves, 60, 1); }
TEST(CompiledProblem, AgreesWithMinimizeOnHalfPlanes) { compare_with_minimize(half_planes, 30, 2); }
TEST(CompiledProblem, AgreesWithMinimizeOnAlternatives) { compare_with_minimize(alternatives, 60, 3); }
TEST(CompiledProblem, AgreesWithMinimizeWhereParametersDecide) {
  compare_with_minimize(by_parameters, 60, 4);
}

double sqr(double x) { return x * x; }
double abs(double x) { return std::abs(x); }

// A long expression, so that it is left out where another one is taken.
template <class Number>
Number long_chain(Number x, Number by, Number one) {
  Number y = x;
  for (int i = 0; i < 60; ++i) y = (y * by + x) / (one + abs(y) + sqr(by));
  return y;
}

TEST(CompiledProblem, TakesAlternativesInTurn) {
  Posed posed({1.0, 1.0, 1.0});
  const Expr one = posed.number(1.0), zero = posed.number(0.0);
  const auto& [a, b, x] = std::tie(posed.given[0], posed.given[1], posed.given[2]);
  const Expr inner = if_then_else(b > zero, long_chain(x + one, b, one), long_chain(x, -a, one) / b);
  const Expr y = posed.real("y");
  posed.problem->constrain("either", y == if_then_else(a > zero, inner, long_chain(x, a - b, one)));
  CompiledProblem compiled = compile(*posed.problem, y);
  for (const auto& [p, q, at] : std::vector<std::array<double, 3>>{
           {1, 2, 0.5}, {-1, 2, 0.5}, {2, -3, 0.25}, {-1, -2, 0.75}, {1, 2, 0.5}, {-2, 0, 1}, {1, -1, 0.5}}) {
    compiled.set(compiled.parameter("p0"), p);
    compiled.set(compiled.parameter("p1"), q);
    compiled.set(compiled.parameter("p2"), at);
    ASSERT_EQ(compiled.solve(), OnlineStatus::solved) << p << " " << q;
    const double wanted = !(p > 0)  ? long_chain(at, p - q, 1.0)
                          : q > 0.0 ? long_chain(at + 1.0, q, 1.0)
                                    : long_chain(at, -p, 1.0) / q;
    EXPECT_NEAR(compiled.objective().mid(), wanted, 1e-12) << p << " " << q;
  }
}

TEST(CompiledProblem, FindsOneSolutionWithoutAnObjective) {
  Posed posed = two_curves({1.0, 0.0, 0.0});
  OnlineOptions options;
  options.outputs = {posed.given[0] + posed.given[1]};
  CompiledProblem compiled = compile(*posed.problem, {}, options);
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  const Interval x = compiled.value(compiled.variable("x"))[0], y = compiled.value(compiled.variable("y"))[0];
  EXPECT_TRUE((sqr(x) + sqr(y)).contains(4.0));
  EXPECT_TRUE((y - sqr(x)).contains(0.0));
  EXPECT_LT(x.width(), 1e-12);
  EXPECT_TRUE(compiled.outputs()[0].contains(1.0));
  EXPECT_TRUE(compiled.value(compiled.variable("p0"))[0] == Interval(1.0));
}

TEST(CompiledProblem, TellsWhatIsInvalid) {
  Posed posed = two_curves({1.0, 0.0, 0.0});
  CompiledProblem compiled = compile(*posed.problem, posed.objective[0]);
  EXPECT_FALSE(compiled.set(compiled.parameter("p1"), std::nan("")));
  EXPECT_EQ(compiled.solve(), OnlineStatus::invalid);
  EXPECT_EQ(compiled.reason(), "p1");
  EXPECT_FALSE(compiled.has_solution());
  EXPECT_TRUE(compiled.set(compiled.parameter("p1"), 0.0));
  EXPECT_EQ(compiled.solve(), OnlineStatus::solved);
  const std::array two{1.0, 2.0};
  EXPECT_FALSE(compiled.set(compiled.parameter("p0"), std::span<const double>(two)));
  EXPECT_EQ(compiled.solve(), OnlineStatus::invalid);
  EXPECT_EQ(compiled.reason(), "p0");
  EXPECT_THROW(static_cast<void>(compiled.parameter("nothing")), std::out_of_range);
}

TEST(CompiledProblem, FollowsWhatChangesUntilItIsSet) {
  Problem problem("follows");
  const Expr a = problem(problem.parameter("a", Interval(1.0)));
  const Expr b = problem(problem.parameter("b", a + a));
  const Expr c = problem(problem.parameter("c", b + a));
  const Expr x = problem(problem.real("x", Interval(-100.0, 100.0)));
  problem.constrain("sum", x == a + b + c);
  CompiledProblem compiled = compile(problem, x);
  const auto expect = [&](double wanted) {
    ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
    EXPECT_EQ(compiled.objective(), Interval(wanted));
  };
  expect(6.0);
  compiled.set(compiled.parameter("a"), 2.0);
  expect(12.0);
  expect(12.0);
  compiled.set(compiled.parameter("b"), 1.0);
  expect(6.0);
  compiled.set(compiled.parameter("a"), 3.0);
  expect(8.0);
  EXPECT_FALSE(compiled.set(compiled.parameter("a"), std::nan("")));
  EXPECT_EQ(compiled.solve(), OnlineStatus::invalid);
  compiled.set(compiled.parameter("a"), 4.0);
  expect(10.0);
  compiled.set(compiled.parameter("c"), 0.0);
  expect(5.0);
}

// Whichever alternative parameters took, it is the same for all of an unknown's values.
TEST(CompiledProblem, SolvesWhereParametersLeaveAnAlternativeOpen) {
  Posed posed({1.0});
  const Expr one = posed.number(1.0), a = posed.given[0], x = posed.real("x");
  posed.problem->constrain("root", x * sqr(x) == if_then_else(a > posed.number(0.0), one + a, one - a));
  CompiledProblem compiled = compile(*posed.problem, x);
  const std::array open{Interval(-1e-15, 1e-15)};
  ASSERT_TRUE(compiled.set(compiled.parameter("p0"), std::span<const Interval>(open)));
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  EXPECT_TRUE(compiled.objective().contains(1.0));
  EXPECT_LT(compiled.objective().width(), 1e-14);
}

TEST(CompiledProblem, NamesWhatRefutes) {
  oracle::TwoCircles circles;
  CompiledProblem compiled = circles.compiled();
  EXPECT_EQ(compiled.solve(), OnlineStatus::solved);
  ASSERT_TRUE(compiled.set(compiled.parameter("c"), 9.0));
  EXPECT_EQ(compiled.solve(), OnlineStatus::infeasible);
  EXPECT_NE(compiled.reason().find("circle"), std::string_view::npos);
}

// Where a family has no solution others may have; what parameters alone refute has none.
TEST(CompiledProblem, AFamilyWithoutASolutionDecidesNothing) {
  Problem problem("family");
  const RealVariable radius = problem.parameter("radius", Interval(1.0));
  const RealVariable x = problem.real("x", Interval(-10.0, 10.0)),
                     y = problem.real("y", Interval(-10.0, 10.0));
  const Expr square = sqr(problem(x)) + sqr(problem(y));
  problem.constrain("circle", square == problem(radius));
  problem.constrain("size", problem(radius) <= problem.constant(Interval(9.0)));
  problem.choose_family("right", problem(x) >= problem.constant(Interval(2.0)));
  CompiledProblem compiled = compile(problem, problem(y));
  EXPECT_EQ(compiled.solve(), OnlineStatus::undecided);
  EXPECT_FALSE(compiled.has_solution());
  EXPECT_FALSE(compiled.reason().empty());
  compiled.set(compiled.parameter("radius"), 5.0);
  EXPECT_EQ(compiled.solve(), OnlineStatus::solved);
  EXPECT_TRUE(compiled.objective().contains(-1.0));
  compiled.set(compiled.parameter("radius"), 10.0);
  EXPECT_EQ(compiled.solve(), OnlineStatus::infeasible);
  EXPECT_EQ(compiled.reason(), "size");
}

TEST(CompiledProblem, AFamilyWithoutASolutionLeavesAllUnexplored) {
  Problem problem("family");
  const RealVariable x = problem.real("x", Interval(-1.0, 1.0));
  problem.choose_family("right", problem(x) >= problem.constant(Interval(2.0)));
  for (const Result& result : {problem.solve_all(), problem.minimize(problem(x))}) {
    EXPECT_EQ(result.status, Status::limit);
    ASSERT_EQ(result.search->unexplored.size(), 1U);
    EXPECT_EQ(std::get<Interval>(result.search->unexplored[0][0].domain), Interval(-1.0, 1.0));
  }
}

TEST(CompiledProblem, RejectsWhatItCannotCompile) {
  Problem tubes("tubes");
  tubes.set_time_line(TimeLine({0.0, 1.0}));
  const auto x = tubes.tube("x", 1);
  tubes.constrain("positive", tubes(x)[0] >= Interval(0.0));
  EXPECT_THROW(compile(tubes, {}), std::invalid_argument);
}

TEST(CompiledProblem, LeavesTheRoundingModeAndAnswersInAny) {
  oracle::StraightLine line(2);
  CompiledProblem compiled = line.compiled();
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  compiled.forget();
  ASSERT_EQ(compiled.solve(), OnlineStatus::solved);
  const Interval expected = compiled.objective();
  for (const int mode : oracle::kRoundingModes) {
    for (const bool flush : {false, true}) {
      const oracle::Environment environment(mode, flush);
      const unsigned before = oracle::control_bits();
      compiled.forget();
      EXPECT_EQ(compiled.solve(), OnlineStatus::solved);
      EXPECT_TRUE(compiled.objective() == expected);
      EXPECT_EQ(oracle::control_bits(), before);
    }
  }
}

// Rest to rest along a line, in closed form.
double rest_to_rest(double distance, double v, double a, double j) {
  const double ramp = v * j >= a * a ? v / a + a / j : 2.0 * std::sqrt(v / j);
  if (distance >= v * ramp) return distance / v + ramp;
  if (distance >= 2.0 * a * a * a / (j * j)) return a / j + std::sqrt(a * a / (j * j) + 4.0 * distance / a);
  return 4.0 * std::cbrt(distance / (2.0 * j));
}

TEST(CompiledProblem, FindsTheFastestMotionFromRestToRest) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> order(-2.0, 2.0);
  oracle::StraightLine line(1);
  CompiledProblem compiled = line.compiled();
  for (int draw = 0; draw < 2000; ++draw) {
    const double d = std::pow(10.0, order(random)), v = std::pow(10.0, order(random)),
                 a = std::pow(10.0, order(random)), j = std::pow(10.0, order(random));
    compiled.set(compiled.parameter("d"), draw % 2 == 0 ? d : -d);
    compiled.set(compiled.parameter("vmax"), v);
    compiled.set(compiled.parameter("amax"), a);
    compiled.set(compiled.parameter("jmax"), j);
    const std::string where = fmt::format("draw {}: {} {} {} {}", draw, d, v, a, j);
    ASSERT_EQ(compiled.solve(), OnlineStatus::solved) << where;
    const double expected = rest_to_rest(d, v, a, j);
    const Interval found = compiled.objective();
    EXPECT_LE(found.lo(), expected * (1.0 + 1e-12)) << where;
    EXPECT_GE(found.hi(), expected * (1.0 - 1e-12)) << where;
    EXPECT_LT(found.width(), 1e-9 * std::max(1.0, expected)) << where;
  }
}

// What people write: round numbers, holds that are exactly zero long, limits at which a motion starts.
TEST(CompiledProblem, SolvesDegenerateMotions) {
  struct Case {
    double d, v0, a0, v1, a1, v, a, j, expected;
  };
  oracle::StraightLine line(1);
  CompiledProblem compiled = line.compiled();
  for (const Case& one : {Case{2, 0, 0, 0, 0, 1, 1, 1, 4}, Case{1, 0, 0, 0, 0, 1, 1, 1, 4 * std::cbrt(0.5)},
                          Case{4, 0, 0, 0, 0, 2, 2, 2, 4}, Case{0, 0, 0, 0, 0, 1, 2, 20, 0},
                          Case{1, 1, 0, 1, 0, 2, 1, 1, 0}, Case{2, 0, 0, 0, 0, 1, 2, 20, 2.6}}) {
    compiled.set(compiled.parameter("d"), one.d);
    compiled.set(compiled.parameter("v0"), one.v0);
    compiled.set(compiled.parameter("a0"), one.a0);
    compiled.set(compiled.parameter("v1"), one.v1);
    compiled.set(compiled.parameter("a1"), one.a1);
    compiled.set(compiled.parameter("vmax"), one.v);
    compiled.set(compiled.parameter("amax"), one.a);
    compiled.set(compiled.parameter("jmax"), one.j);
    EXPECT_EQ(compiled.solve(), OnlineStatus::solved) << one.d << " " << one.v0;
    if (one.expected > 0) {
      EXPECT_NEAR(compiled.objective().hi(), one.expected, 1e-9);
    }
  }
}

}  // namespace
}  // namespace hcsp
