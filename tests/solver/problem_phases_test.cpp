// SPDX-License-Identifier: Apache-2.0
// Problems on a time line with phases, through the builder API.
#include <gtest/gtest.h>

#include "solver/problem.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

struct Line {
  Problem problem{"motion"};
  RealVariable end = problem.real("T", Interval(0.0, 20.0));
  VectorVariable tau;
  explicit Line(const Box& durations) : tau(problem.vector("tau", durations)) {
    problem.set_phases(problem(end), problem(tau));
  }
  Expr constant(double value) { return problem.constant(Interval(value)); }
  TubeVariable hold(const std::vector<double>& values) {
    std::vector<VectorExpr> held;
    for (const double value : values) held.push_back({constant(value)});
    return problem.hold(held);
  }
  Expr at(TubeVariable x, Expr instant) { return problem.at(x, instant)[0]; }
};

// The value of a polynomial of each phase, exactly, where all numbers are dyadic.
struct Motion {
  std::vector<double> durations, jerks;
  double a0, v0, x0;
  struct State {
    double x, v, a;
  };
  [[nodiscard]] State after(std::size_t phases) const {
    State now{x0, v0, a0};
    for (std::size_t i = 0; i < phases; ++i) now = moved(now, jerks[i], durations[i]);
    return now;
  }
  static State moved(const State& from, double j, double s) {
    return {from.x + from.v * s + from.a * s * s / 2 + j * s * s * s / 6, from.v + from.a * s + j * s * s / 2,
            from.a + j * s};
  }
};

Motion random_motion(oracle::Dice& dice) {
  Motion motion{
      {}, {}, oracle::dyadic(dice, -2, 2), oracle::dyadic(dice, -2, 2), oracle::dyadic(dice, -2, 2)};
  const int phases = 1 + dice.below(4);
  for (int i = 0; i < phases; ++i) {
    motion.durations.push_back(dice.below(4) == 0 ? 0.0 : oracle::dyadic(dice, 0, 2, 2));
    motion.jerks.push_back(6.0 * dice.below(5) - 12.0);
  }
  return motion;
}

// A state at the end that a motion has is found with the motion's durations in the box, and never lost.
TEST(Phases, NoMotionIsLost) {
  oracle::for_seeds(60, [](oracle::Dice& dice) {
    const Motion motion = random_motion(dice);
    const std::size_t n = motion.durations.size();
    Box around(static_cast<Eigen::Index>(n));
    for (std::size_t i = 0; i < n; ++i)
      around[static_cast<Eigen::Index>(i)] = Interval(motion.durations[i] - oracle::dyadic(dice, 0, 1),
                                                      motion.durations[i] + oracle::dyadic(dice, 0, 1));
    Line line(around);
    Problem& p = line.problem;
    const TubeVariable x = p.tube("x", 1), v = p.tube("v", 1), a = p.tube("a", 1);
    p.constrain_derivative("x'", x, p(v));
    p.constrain_derivative("v'", v, p(a));
    p.constrain_derivative("a'", a, p(line.hold(motion.jerks)));
    p.constrain("start", line.at(x, line.constant(0)) == line.constant(motion.x0) &&
                             line.at(v, line.constant(0)) == line.constant(motion.v0) &&
                             line.at(a, line.constant(0)) == line.constant(motion.a0));
    const auto state = motion.after(n);
    p.constrain("goal", line.at(x, p(line.end)) == line.constant(state.x) &&
                            line.at(v, p(line.end)) == line.constant(state.v) &&
                            line.at(a, p(line.end)) == line.constant(state.a));
    const Result contracted = p.propagate();
    double total = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      total += motion.durations[i];
      EXPECT_TRUE(
          std::get<Box>(contracted["tau"])[static_cast<Eigen::Index>(i)].contains(motion.durations[i]));
    }
    EXPECT_TRUE(std::get<Interval>(contracted["T"]).contains(total));
    const auto& tube = std::get<PolynomialTube>(contracted["x"]);
    for (std::size_t k = 0; k <= n; ++k) EXPECT_TRUE(tube.gate(0, k).contains(motion.after(k).x));
    double begin = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double s = motion.durations[i] * oracle::dyadic(dice, 0, 1);
      const double value = Motion::moved(motion.after(i), motion.jerks[i], s).x;
      EXPECT_TRUE(tube.slice(0, i).contains(value));
      EXPECT_TRUE(tube.at(0, Interval(begin + s)).contains(value));
      begin += motion.durations[i];
    }
  });
}

// The fastest way of 1 m from rest to rest with a <= 2 and v <= 1: 0.5 s up, 0.5 s level, 0.5 s down.
TEST(Phases, TheFastestMotionKeepsItsLimits) {
  Line line(Box({Interval(0.0, 10.0), Interval(0.0, 10.0), Interval(0.0, 10.0)}));
  Problem& p = line.problem;
  const TubeVariable x = p.tube("x", 1), v = p.tube("v", 1), other = p.tube("other", 1);
  p.constrain("limit", p(v)[0] <= Interval(1.0));
  p.constrain_derivative("x'", x, p(v));
  p.constrain_derivative("v'", v, p(line.hold({2.0, 0.0, -2.0})));
  p.constrain("start", line.at(v, line.constant(0)) == line.constant(0) &&
                           line.at(x, line.constant(0)) == line.constant(0));
  p.constrain("goal",
              line.at(v, p(line.end)) == line.constant(0) && line.at(x, p.gate(3)) == line.constant(1));
  p.constrain("double", p(other)[0] == Interval(2.0) * p(x)[0]);
  p.constrain_derivative("other'", other, {Interval(2.0) * p(v)[0]});
  const Result result = p.minimize(p(line.end), {.precision = 1e-9});
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_TRUE(result.objective->contains(1.5));
  EXPECT_LE(result.objective->width(), 1e-8);
  const auto& best = result.search->solutions.front();
  EXPECT_EQ(best.certificate, Certificate::exists);
  for (const ResultVariable& variable : best.variables) {
    if (variable.name != "other") continue;
    const auto& tube = std::get<PolynomialTube>(variable.domain);
    EXPECT_TRUE(tube.gate(0, 3).contains(2.0));
    EXPECT_LE(tube.gate(0, 3).width(), 1e-9);
  }
}

// A speed that is greatest between the gates breaks a limit that it keeps at all of them.
TEST(Phases, LimitsHoldBetweenTheGates) {
  for (const double limit : {0.9, 1.0, 1.1}) {
    Line line(Box({Interval(2.0)}));
    Problem& p = line.problem;
    const TubeVariable v = p.tube("v", 1), a = p.tube("a", 1);
    p.constrain_derivative("v'", v, p(a));
    p.constrain_derivative("a'", a, p(line.hold({-2.0})));
    p.constrain("start", line.at(v, line.constant(0)) == line.constant(0) &&
                             line.at(a, line.constant(0)) == line.constant(2));
    p.constrain("limit", p(v)[0] <= Interval(limit));
    EXPECT_EQ(p.propagate().status, limit < 1.0 ? Status::infeasible : Status::contracted) << limit;
  }
}

// What is said of a part of the time is not asked of the rest.
TEST(Phases, ALimitMayHoldFromAGateOn) {
  for (const std::size_t from : {0U, 1U}) {
    Line line(Box({Interval(1.0), Interval(1.0)}));
    Problem& p = line.problem;
    const TubeVariable v = p.tube("v", 1);
    p.constrain_derivative("v'", v, p(line.hold({-2.0, 1.0})));
    p.constrain("start", line.at(v, line.constant(0)) == line.constant(3));
    p.during_phases(from, 2, [&] { p.constrain("limit", p(v)[0] <= Interval(2.5)); });
    EXPECT_EQ(p.propagate().status, from == 0 ? Status::infeasible : Status::contracted);
    EXPECT_THROW(p.during_phases(1, 1, [] {}), std::invalid_argument);
  }
}

TEST(Phases, AnUnknownStartIsFound) {
  Line line(Box({Interval(1.0), Interval(2.0)}));
  Problem& p = line.problem;
  const TubeVariable x = p.tube("x", 1);
  p.constrain_derivative("x'", x, p(line.hold({3.0, -1.0})));
  p.constrain("seen", line.at(x, p.gate(1)) == line.constant(5));
  const Result result = p.solve_all();
  ASSERT_EQ(result.search->solutions.size(), 1U);
  const auto& tube = std::get<PolynomialTube>(result["x"]);
  EXPECT_TRUE(tube.gate(0, 0).contains(2.0) && tube.gate(0, 2).contains(3.0));
  EXPECT_LE(tube.gate(0, 2).width(), 1e-12);
  EXPECT_TRUE(tube.at(0, Interval(2.0)).contains(4.0));
  EXPECT_TRUE(tube.at(0, Interval(3.5)).is_empty());
}

TEST(Phases, MisuseIsAnException) {
  Line line(Box({Interval(0.0, 1.0), Interval(0.0, 1.0)}));
  Problem& p = line.problem;
  const TubeVariable x = p.tube("x", 1);
  EXPECT_THROW(p.gate(3), std::invalid_argument);
  EXPECT_THROW(p.at(x, 0.5), std::invalid_argument);
  EXPECT_THROW(p.hold({{line.constant(1)}}), std::invalid_argument);
  EXPECT_THROW(p.set_phases(p(line.end), p(line.tau)), std::invalid_argument);
  EXPECT_THROW(p.delayed(x, 0.5), std::invalid_argument);
  EXPECT_THROW(p.constrain_sometime("some", p(x)[0] > Interval(0.0)), std::invalid_argument);
  EXPECT_THROW(p.define_phases(), PhaseError);  // x has no definition
  Line bent(Box({Interval(0.0, 1.0)}));
  const TubeVariable y = bent.problem.tube("y", 1);
  bent.problem.constrain_derivative("y'", y, {bent.constant(1)});
  bent.problem.constrain("bent", sin(bent.problem(y)[0]) <= Interval(0.5));
  try {
    bent.problem.propagate();
    ADD_FAILURE();
  } catch (const PhaseError& error) {
    EXPECT_EQ(error.constraint, "bent");
  }
}

// Numbers that are given are constants of a search: it finds a solution for each of their values.
TEST(Parameters, AreNeverSolvedFor) {
  Problem p("given");
  const RealVariable a = p.parameter("a", Interval(4.0)), x = p.real("x", Interval(-10.0, 10.0));
  const RealVariable b = p.parameter("b", p(a) / Interval(2.0));
  p.constrain("square", sqr(p(x)) == p(a) * p(b));
  p.imply("positive", p(x) >= Interval(0.0));
  const Result result = p.solve_all();
  ASSERT_EQ(result.search->solutions.size(), 1U);
  EXPECT_EQ(result.search->solutions[0].certificate, Certificate::unique);
  EXPECT_TRUE(std::get<Interval>(result["x"]).contains(2.8284271247461903));
  EXPECT_EQ(std::get<Interval>(result["b"]), Interval(2.0));
}

// What is implied makes a system no larger: it contracts, and a solution is still proven to be alone.
TEST(Implied, IsNotAnEquationOfProofs) {
  for (const bool is_implied : {false, true}) {
    Problem p("implied");
    const RealVariable x = p.real("x", Interval(0.0, 5.0)), y = p.real("y", Interval(0.0, 5.0));
    p.constrain("sum", p(x) * p(x) + p(y) == Interval(5.0));
    p.constrain("difference", p(x) - p(y) * p(y) == Interval(1.0));
    const Expr product = p(x) * (p(x) - p(y) * p(y)) == p(x);
    is_implied ? p.imply("once more", product) : p.constrain("once more", product);
    const Result result = p.solve_all();
    ASSERT_FALSE(result.search->solutions.empty());
    const Solution& solution = result.search->solutions.front();
    EXPECT_EQ(solution.certificate, is_implied ? Certificate::unique : Certificate::none);
    const Result least = p.minimize(p(x));
    EXPECT_EQ(least.search->solutions.front().certificate == Certificate::exists, is_implied);
  }
}

// Stated before the constraint that it repeats, it takes nothing from that one's proof.
TEST(Implied, DoesNotStandForAConstraint) {
  Problem p("order");
  const RealVariable x = p.real("x", Interval(0.0, 5.0)), y = p.real("y", Interval(0.0, 5.0));
  p.imply("first", p(x) + p(y) == Interval(3.0));
  p.constrain("sum", p(x) + p(y) == Interval(3.0));
  p.constrain("difference", p(x) - p(y) == Interval(1.0));
  const Result result = p.solve_all();
  ASSERT_EQ(result.search->solutions.size(), 1U);
  EXPECT_EQ(result.search->solutions[0].certificate, Certificate::unique);
  Problem alone("alone");
  const RealVariable z = alone.real("z", Interval(0.0, 5.0)), w = alone.real("w", Interval(0.0, 5.0));
  alone.imply("only", alone(z) + alone(w) == Interval(3.0));
  alone.constrain("difference", alone(z) - alone(w) == Interval(1.0));
  for (const Solution& solution : alone.solve_all({.precision = 0.1}).search->solutions)
    EXPECT_NE(solution.certificate, Certificate::unique);
}

}  // namespace
}  // namespace hcsp
