// SPDX-License-Identifier: Apache-2.0
#include "solver/search/branch_and_bound.h"

#include <gtest/gtest.h>

#include <random>

#include "solver/problem.h"

namespace hcsp {
namespace {

SearchOptions fine(double precision = 1e-6, unsigned threads = 1) {
  SearchOptions options;
  options.precision = precision;
  options.threads = threads;
  options.time_limit = 20.0;
  return options;
}

Box cube(std::size_t dim, double lo, double hi) {
  Box box(static_cast<Eigen::Index>(dim));
  for (Eigen::Index i = 0; i < box.dim(); ++i) box[i] = Interval(lo, hi);
  return box;
}

void expect_minimum(const Result& result, const Interval& truth, double width) {
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_FALSE(meet(*result.objective, truth).is_empty()) << to_string(*result.objective);
  EXPECT_LE(result.objective->width(), width);
  ASSERT_FALSE(result.search->solutions.empty());
  EXPECT_EQ(result.search->solutions.front().certificate, Certificate::exists);
}

TEST(BranchAndBound, FindsTheMinimumOfSimpleProblems) {
  {
    Problem problem("circle");
    const auto p = problem.vector("p", cube(2, -10.0, 10.0));
    const Expr x = problem.component(p, 0), y = problem.component(p, 1);
    problem.constrain("circle", x * x + y * y == Interval(1.0));
    expect_minimum(problem.minimize(x + y, fine()), -sqrt(Interval(2.0)), 2e-6);
    const Result most = problem.maximize(x + y, fine());
    EXPECT_FALSE(meet(*most.objective, sqrt(Interval(2.0))).is_empty());
  }
  {
    Problem problem("corner");
    const auto p = problem.vector("p", cube(2, 0.0, 3.0));
    const Expr x = problem.component(p, 0), y = problem.component(p, 1);
    expect_minimum(problem.minimize(x * y - x - y, fine()), Interval(-3.0), 1e-5);
  }
  {
    Problem problem("whole");
    const IntegerVariable m = problem.integer("m", Interval(0.0, 10.0)),
                          n = problem.integer("n", Interval(0.0, 10.0));
    const BooleanVariable both = problem.boolean("both");
    const Expr x = problem(m), y = problem(n);
    problem.constrain("knapsack", Interval(3.0) * x + Interval(5.0) * y <= Interval(19.0));
    problem.constrain("both", !problem(both) || (x >= Interval(1.0) && y >= Interval(1.0)));
    problem.constrain("asked", problem(both));
    const Result result = problem.maximize(Interval(4.0) * x + Interval(7.0) * y, fine());
    EXPECT_TRUE(result.objective->contains(26.0)) << to_string(*result.objective);
    EXPECT_LE(result.objective->width(), 1e-4);
    EXPECT_EQ(result.status, Status::solved);
  }
  {
    Problem problem("choice");
    const RealVariable v = problem.real("x", Interval(-5.0, 5.0));
    const Expr x = problem(v);
    problem.constrain("apart", x <= Interval(-2.0) || x >= Interval(1.0));
    const Result result = problem.minimize(if_then_else(x > Interval(0.0), x * x, x * x - x), fine());
    expect_minimum(result, Interval(1.0), 1e-5);
  }
}

TEST(BranchAndBound, TellsWhatIsInfeasibleUnboundedOrUnproven) {
  {
    Problem problem("apart");
    const auto p = problem.vector("p", cube(2, -10.0, 10.0));
    const Expr x = problem.component(p, 0), y = problem.component(p, 1);
    problem.constrain("one", sqr(x - Interval(2.0)) + y * y <= Interval(1.0));
    problem.constrain("other", sqr(x + Interval(2.0)) + y * y <= Interval(1.0));
    const Result result = problem.minimize(y, fine());
    EXPECT_EQ(result.status, Status::infeasible);
    EXPECT_TRUE(result.objective->is_empty());
    EXPECT_TRUE(result.search->solutions.empty());
  }
  {
    Problem problem("ray");
    const Expr x = problem(problem.real("x", Interval(0.0, kInfinity)));
    const Result result = problem.minimize(-x, fine());
    EXPECT_EQ(result.objective->lo(), -kInfinity);
  }
  {
    Problem problem("double root");
    const Expr x = problem(problem.real("x", Interval(-1.0, 1.0)));
    problem.constrain("touches", sqr(x - Interval(0.25)) == Interval(0.0));
    const Result result = problem.minimize(x, fine());
    EXPECT_NE(result.status, Status::infeasible);
    EXPECT_TRUE(result.objective->contains(0.25));
  }
}

// Functions that are partial, and unbounded domains.
TEST(BranchAndBound, MinimisesOverWhatIsDefined) {
  Problem problem("partial");
  const auto p = problem.vector("p", Box(2));
  const Expr x = problem.component(p, 0), y = problem.component(p, 1);
  problem.constrain("root", sqrt(x) <= Interval(3.0));
  problem.constrain("product", x * y >= Interval(1.0));
  expect_minimum(problem.minimize(x * x + exp(y) - log(x), fine(1e-5)), Interval(3.55857864, 3.55857867),
                 1e-4);
}

TEST(BranchAndBound, EveryMinimiserIsInABox) {
  Problem problem("two wells");
  const Expr x = problem(problem.real("x", Interval(-3.0, 3.0)));
  const Result result = problem.minimize(sqr(x * x - Interval(2.0)), fine(1e-9));
  expect_minimum(result, Interval(0.0), 1e-9);
  for (const double sign : {-1.0, 1.0}) {
    const Interval root = Interval(sign) * sqrt(Interval(2.0));
    const bool is_held = std::any_of(
        result.search->solutions.begin() + 1, result.search->solutions.end(), [&](const Solution& solution) {
          return leq(root, std::get<Interval>(solution.variables.front().domain));
        });
    EXPECT_TRUE(is_held) << sign;
  }
}

// Convex programs whose minimiser is built: the gradient there is minus a sum of the active rows' normals.
TEST(BranchAndBound, ConvexProgramsOfKnownMinimum) {
  std::mt19937_64 random(30);
  std::uniform_int_distribution<int> small(-3, 3), positive(1, 4), where(-2, 2);
  for (int k = 0; k < 60; ++k) {
    const std::size_t n = 2 + static_cast<std::size_t>(k % 3);
    Problem problem("convex");
    const VectorExpr x = problem(problem.vector("x", cube(n, -8.0, 8.0)));
    std::vector<int> best(n), curvature(n), gradient(n, 0);
    for (std::size_t v = 0; v < n; ++v) best[v] = where(random), curvature[v] = 2 * positive(random);
    for (int row = 0; row < 3; ++row) {
      const int multiplier = row < 2 ? positive(random) : 0, slack = row < 2 ? 0 : positive(random);
      Expr left = problem.constant(Interval(0.0));
      int most = slack;
      for (std::size_t v = 0; v < n; ++v) {
        const int factor = small(random);
        left = left + Interval(factor) * x[v];
        most += factor * best[v];
        gradient[v] -= multiplier * factor;
      }
      problem.constrain("row", left <= Interval(most));
    }
    Expr objective = problem.constant(Interval(0.0));
    int minimum = 0;  // curvature / 2 (x - best)^2 + gradient (x - best) + gradient best
    for (std::size_t v = 0; v < n; ++v) {
      objective = objective + Interval(curvature[v] / 2) * sqr(x[v] - Interval(best[v])) +
                  Interval(gradient[v]) * x[v];
      minimum += gradient[v] * best[v];
    }
    SCOPED_TRACE(k);
    expect_minimum(problem.minimize(objective, fine(1e-5)), Interval(minimum), 1e-3);
  }
}

// What is found is never above the value at a feasible point that was drawn.
TEST(BranchAndBound, NoFeasiblePointIsBelowTheBracket) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  for (int k = 0; k < 40; ++k) {
    Problem problem("waves");
    const auto p = problem.vector("p", cube(2, -2.0, 2.0));
    const Expr x = problem.component(p, 0), y = problem.component(p, 1);
    std::vector<double> c(8);
    for (double& value : c) value = number(random);
    const auto objective = [&](const auto& at_x, const auto& at_y) {
      return Interval(c[0]) * sin(Interval(3.0) * at_x + Interval(c[1])) * at_y + Interval(c[2]) * sqr(at_x) +
             Interval(c[3]) * at_x * at_y + Interval(c[4]) * cos(Interval(2.0) * at_y);
    };
    const auto limit = [&](const auto& at_x, const auto& at_y) {
      return Interval(c[5]) * at_x * at_y + Interval(c[6]) * at_y - sqr(at_x) * Interval(c[7]);
    };
    problem.constrain("limit", limit(x, y) <= Interval(0.5));
    const Result result = problem.minimize(objective(x, y), fine(1e-4));
    ASSERT_EQ(result.status, Status::solved) << k;
    for (int draw = 0; draw < 300; ++draw) {
      const Interval at_x(number(random)), at_y(number(random));
      if (limit(at_x, at_y).hi() > 0.5) continue;
      ASSERT_LE(result.objective->lo(), objective(at_x, at_y).hi()) << k;
    }
    ASSERT_TRUE(is_close(*result.objective, fine(1e-4))) << k << to_string(*result.objective);
  }
}

struct Griewank {
  Problem problem{"griewank"};
  Expr objective;
  Griewank() : objective(problem.constant(Interval(1.0))) {
    const VectorExpr x = problem(problem.vector("x", cube(3, -100.0, 150.0)));
    Expr product = problem.constant(Interval(1.0));
    for (std::size_t v = 0; v < 3; ++v) {
      objective = objective + sqr(x[v]) / Interval(4000.0);
      product = product * cos(x[v] / sqrt(Interval(static_cast<double>(v + 1))));
    }
    objective = objective - product;
  }
};

TEST(BranchAndBound, AnswersOverlapForAnyNumberOfThreads) {
  Griewank griewank;
  for (const unsigned threads : {1U, 2U, 5U}) {
    expect_minimum(griewank.problem.minimize(griewank.objective, fine(1e-9, threads)), Interval(0.0), 1e-9);
    SearchOptions depth = fine(1e-9, threads);
    depth.order = SearchOrder::depth_first;
    expect_minimum(griewank.problem.minimize(griewank.objective, depth), Interval(0.0), 1e-9);
  }
}

TEST(BranchAndBound, ALimitLeavesAGuaranteedBracket) {
  Griewank griewank;
  std::atomic<bool> stop = true;
  SearchOptions options = fine(1e-12);
  options.cancel = &stop;
  const Result result = griewank.problem.minimize(griewank.objective, options);
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_TRUE(result.objective->contains(0.0));
  EXPECT_EQ(result.search->unexplored.size(), 1U);
}

TEST(BranchAndBound, GoesOnFromACheckpoint) {
  Griewank griewank;
  std::string state;
  std::atomic<bool> stop = false;
  SearchOptions options = fine(1e-9);
  options.checkpoint_period = 1e-4;
  options.cancel = &stop;
  options.checkpoint = [&](const std::string& kept) {
    state = kept;
    stop = true;
  };
  griewank.problem.minimize(griewank.objective, options);
  ASSERT_FALSE(state.empty());
  SearchOptions rest = fine(1e-9);
  rest.resume = state;
  expect_minimum(griewank.problem.minimize(griewank.objective, rest), Interval(0.0), 1e-9);
}

TEST(BranchAndBound, RefusesWhatIsNoNumberOrNoSystem) {
  Problem problem("wrong");
  const Expr x = problem(problem.real("x"));
  EXPECT_THROW(problem.minimize(x < Interval(1.0)), std::invalid_argument);
  EXPECT_THROW(problem.minimize(x, fine(0.0)), std::invalid_argument);
  Problem other("other");
  EXPECT_THROW(other.minimize(x), std::invalid_argument);
}

TEST(BranchAndBound, AGapIsAbsoluteOrRelative) {
  EXPECT_TRUE(is_close(Interval(0.0, 1e-3), fine(1e-3)));
  EXPECT_TRUE(is_close(Interval(1e6, 1e6 + 900.0), fine(1e-3)));
  EXPECT_TRUE(is_close(Interval(-1e6, -1e6 + 900.0), fine(1e-3)));
  EXPECT_FALSE(is_close(Interval(-1.0, 1e6), fine(1e-3)));
  EXPECT_FALSE(is_close(Interval::raw(-kInfinity, 1.0), fine(1e-3)));
}

}  // namespace
}  // namespace hcsp
