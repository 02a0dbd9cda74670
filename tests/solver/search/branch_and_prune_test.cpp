// SPDX-License-Identifier: Apache-2.0
#include "solver/search/branch_and_prune.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/problem.h"

namespace hcsp {
namespace {

std::vector<Interval> values(const Solution& solution) {
  std::vector<Interval> all;
  for (const ResultVariable& variable : solution.variables)
    all.push_back(std::get<Interval>(variable.domain));
  return all;
}

std::size_t count(const Result& result, Certificate certificate, Reason reason = Reason::proven) {
  const auto& all = result.search->solutions;
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Solution& solution) {
    return solution.certificate == certificate && solution.reason == reason;
  }));
}

bool some_box_holds(const Result& result, const std::vector<double>& point) {
  const auto& all = result.search->solutions;
  return std::any_of(all.begin(), all.end(), [&](const Solution& solution) {
    const std::vector<Interval> box = values(solution);
    return std::equal(box.begin(), box.end(), point.begin(),
                      [](const Interval& x, double value) { return x.contains(value); });
  });
}

struct BranchAndPrune : ::testing::Test {
  Problem problem{"system"};
  Expr x = problem(problem.real("x", {-10, 10}));
  Expr y = problem(problem.real("y", {-10, 10}));
};

TEST_F(BranchAndPrune, IsolatesAndCertifiesRegularSolutions) {
  problem.constrain("circle", sqr(x) + sqr(y) == Interval(5.0));
  problem.constrain("hyperbola", x * y == Interval(2.0));
  const Result result = problem.solve_all();
  EXPECT_EQ(result.status, Status::solved);
  ASSERT_EQ(result.search->solutions.size(), 4U);
  EXPECT_EQ(count(result, Certificate::unique), 4U);
  for (const auto& point : {std::vector{-2.0, -1.0}, {-1.0, -2.0}, {1.0, 2.0}, {2.0, 1.0}})
    EXPECT_TRUE(some_box_holds(result, point));
  for (const Solution& solution : result.search->solutions) {
    for (const Interval& side : values(solution)) EXPECT_LT(side.width(), 1e-12);
  }
  EXPECT_EQ(std::get<Interval>(result["x"]),
            join(values(result.search->solutions.front())[0], values(result.search->solutions.back())[0]));
}

TEST_F(BranchAndPrune, ProvesThatThereIsNone) {
  problem.constrain("circle", sqr(x) + sqr(y) == Interval(1.0));
  problem.constrain("line", x + y == Interval(3.0));
  const Result result = problem.solve_all();
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_TRUE(result.search->solutions.empty());
  EXPECT_TRUE(std::get<Interval>(result["x"]).is_empty());
}

// Solutions where boxes are cut, and at the edge of the domains, are found once.
TEST_F(BranchAndPrune, TellsNoSolutionTwice) {
  problem.constrain("cut", x * (sqr(x) - Interval(25.0)) == Interval(0.0));
  problem.constrain("y", y == x);
  const Result result = problem.solve_all();
  EXPECT_EQ(count(result, Certificate::unique), 3U);
  EXPECT_EQ(result.search->solutions.size(), 3U);
}

TEST_F(BranchAndPrune, DoesNotCertifyADoubleRoot) {
  problem.constrain("touch", sqr(x - Interval(1.0)) == Interval(0.0));
  problem.constrain("y", y == x + Interval(1.0));
  SearchOptions options;
  options.precision = 1e-4;
  const Result result = problem.solve_all(options);
  EXPECT_GT(count(result, Certificate::none, Reason::singular), 0U);
  EXPECT_EQ(count(result, Certificate::unique), 0U);
  EXPECT_TRUE(some_box_holds(result, {1.0, 2.0}));
}

TEST_F(BranchAndPrune, LeavesAnEdgeOfTheDomainOpen) {
  Problem edge("edge");
  const Expr z = edge(edge.real("z", Interval(std::sqrt(2.0), 10.0)));  // sqrt(2) is just below, or above
  edge.constrain("root", sqr(z) == Interval(2.0));
  const Result result = edge.solve_all();
  EXPECT_EQ(count(result, Certificate::unique), 0U);
}

TEST_F(BranchAndPrune, TellsInequalitiesApart) {
  problem.constrain("circle", sqr(x) + sqr(y) == Interval(3.0));
  problem.constrain("hyperbola", x * y == Interval(1.0));
  problem.constrain("right", x > Interval(0.0));
  problem.constrain("edge", x + Interval(2.0) * y <= sqrt(problem.constant(5.0)) + y);  // an equality of both
  problem.constrain("below", x > y);
  const Result result = problem.solve_all();
  EXPECT_EQ(result.search->solutions.size(), 1U);
  EXPECT_EQ(count(result, Certificate::none, Reason::boundary), 1U);
}

TEST_F(BranchAndPrune, CoversACurve) {
  problem.constrain("circle", sqr(x) + sqr(y) == Interval(4.0));
  SearchOptions options;
  options.precision = 0.05;
  const Result result = problem.solve_all(options);
  EXPECT_GT(count(result, Certificate::exists), 200U);
  EXPECT_EQ(count(result, Certificate::exists) + count(result, Certificate::none, Reason::manifold),
            result.search->solutions.size());
  for (double angle = 0; angle < 6.28; angle += 0.01) {
    const auto& all = result.search->solutions;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Solution& solution) {
      const auto box = values(solution);
      constexpr double kRounding = 1e-14;
      return !meet(box[0], Interval(2 * std::cos(angle) - kRounding, 2 * std::cos(angle) + kRounding))
                  .is_empty() &&
             !meet(box[1], Interval(2 * std::sin(angle) - kRounding, 2 * std::sin(angle) + kRounding))
                  .is_empty();
    })) << angle;
  }
}

TEST_F(BranchAndPrune, FindsWhatIsInside) {
  problem.constrain("disc", sqr(x) + sqr(y) <= Interval(4.0));
  SearchOptions options;
  options.precision = 0.25;
  const Result result = problem.solve_all(options);
  double area = 0, border = 0;
  for (const Solution& solution : result.search->solutions) {
    const auto box = values(solution);
    (solution.certificate == Certificate::inner ? area : border) += box[0].width() * box[1].width();
    EXPECT_TRUE(solution.certificate == Certificate::inner || solution.reason == Reason::boundary);
  }
  const double disc = 4 * std::acos(-1.0);
  EXPECT_LT(area, disc);
  EXPECT_GT(area + border, disc);
  EXPECT_LT(border, 6.0);
}

TEST_F(BranchAndPrune, DoesNotCertifyMoreEquationsThanUnknowns) {
  problem.constrain("circle", sqr(x) + sqr(y) == Interval(5.0));
  problem.constrain("hyperbola", x * y == Interval(2.0));
  problem.constrain("line", x + y == Interval(3.0));
  const Result result = problem.solve_all();
  EXPECT_EQ(count(result, Certificate::none, Reason::overdetermined), 2U);
  EXPECT_EQ(result.search->solutions.size(), 2U);
}

TEST_F(BranchAndPrune, CertifiesInSpiteOfEquationsThatOthersImply) {
  problem.constrain("circle", sqr(x) + sqr(y) == Interval(5.0));
  problem.constrain("line", x + y == Interval(3.0));
  problem.constrain("line again", Interval(2.0) * x + Interval(2.0) * y == Interval(6.0));
  problem.constrain("circle again", sqr(x) + sqr(y) == Interval(5.0));
  const Result result = problem.solve_all();
  EXPECT_EQ(count(result, Certificate::unique), 2U);
  EXPECT_EQ(result.search->solutions.size(), 2U);
}

TEST_F(BranchAndPrune, KnowsWholeNumbersAndChoices) {
  const auto n = problem.integer("n", {0, 5});
  const auto b = problem.boolean("b");
  problem.constrain("circle", sqr(x) + sqr(y) == problem(n) + Interval(2.0));
  problem.constrain("line", x == Interval(2.0) * y);
  problem.constrain("either",
                    problem(n) == Interval(3.0) || (problem(n) == Interval(1.0) && x > Interval(0.0)));
  problem.constrain("told", (problem(b) && x > Interval(0.0)) || (!problem(b) && x <= Interval(0.0)));
  const Result result = problem.solve_all();
  EXPECT_EQ(result.search->solutions.size(), 3U);
  EXPECT_EQ(count(result, Certificate::unique), 3U);
  EXPECT_TRUE(some_box_holds(result, {2.0, 1.0, 3.0, 1.0}));
  EXPECT_TRUE(some_box_holds(result, {-2.0, -1.0, 3.0, 0.0}));
}

// What is in no relation may have any value.
TEST_F(BranchAndPrune, LeavesFreeUnknownsAlone) {
  problem.constrain("root", sqr(x) == Interval(2.0));
  const Result result = problem.solve_all();
  EXPECT_EQ(count(result, Certificate::exists), 2U);
  EXPECT_EQ(values(result.search->solutions[0])[1], Interval(-10, 10));
  Problem whole("whole");
  whole.integer("n", {0.5, 3.2});
  EXPECT_EQ(values(whole.solve_all().search->solutions.at(0)), std::vector{Interval(1, 3)});
  Problem none("none");
  none.integer("n", {0.3, 0.7});
  none.constrain("c", none(none.real("x", {0, 1})) >= Interval(0.0));
  EXPECT_EQ(none.solve_all().status, Status::infeasible);
  EXPECT_EQ(none.minimize(none.constant(1.0)).status, Status::infeasible);
  const Result told = none.propagate();
  EXPECT_EQ(told.explanation->constraint, "domain of n");
  Problem nothing("nothing");
  nothing.real("x");
  EXPECT_EQ(count(nothing.solve_all(), Certificate::inner), 1U);
}

TEST_F(BranchAndPrune, AnswersTheSameWithAnyThreads) {
  problem.constrain("a", sin(x * y) + x == Interval(1.0));
  problem.constrain("b", cos(x - y) * y == Interval(0.5));
  const Result one = problem.solve_all();
  EXPECT_GT(one.search->solutions.size(), 5U);
  for (const unsigned threads : {2U, 3U, 8U}) {
    SearchOptions options;
    options.threads = threads;
    const Result several = problem.solve_all(options);
    ASSERT_EQ(several.search->solutions.size(), one.search->solutions.size());
    EXPECT_EQ(several.search->cells, one.search->cells);
    for (std::size_t i = 0; i < one.search->solutions.size(); ++i) {
      EXPECT_EQ(values(several.search->solutions[i]), values(one.search->solutions[i]));
      EXPECT_EQ(several.search->solutions[i].certificate, one.search->solutions[i].certificate);
    }
  }
}

// Unbounded domains are cut too, and what a limit leaves is told.
TEST(BranchAndPruneLimits, LosesNothingAtALimit) {
  Problem problem("long");
  const Expr x = problem(problem.real("x")), y = problem(problem.real("y"));
  problem.constrain("a", sin(x) == y);
  problem.constrain("b", y * x == Interval(1.0));
  double now = 0;
  SearchOptions options;
  options.clock = [&] { return now += 0.001; };
  options.time_limit = 0.5;
  const Result result = problem.solve_all(options);
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_FALSE(result.search->unexplored.empty());
  // sin(x) x == 1 near 1.114157 and near every multiple of pi.
  for (const double point : {1.1141571408719302, 2.7726047082659912, 1e5 * 3.141592653589793}) {
    const auto holds = [&](const std::vector<ResultVariable>& box) {
      constexpr double kAround = 1e-4;
      return !meet(std::get<Interval>(box[0].domain), Interval(point - kAround, point + kAround)).is_empty();
    };
    const auto& search = *result.search;
    EXPECT_TRUE(std::any_of(search.unexplored.begin(), search.unexplored.end(), holds) ||
                std::any_of(search.solutions.begin(), search.solutions.end(),
                            [&](const Solution& solution) { return holds(solution.variables); }))
        << point;
  }
}

TEST(BranchAndPruneLimits, RefusesWhatIsNoSystem) {
  Problem problem("tube");
  problem.set_time_line(TimeLine({0, 1}));
  problem.tube("x", 1);
  EXPECT_FALSE(problem.is_system());
  EXPECT_THROW(problem.solve_all(), std::invalid_argument);
  Problem alternatives("alternatives");
  const auto y = alternatives.real("y");
  alternatives.constrain_at_least("c", 1,
                                  {[&] { alternatives.constrain("a", alternatives(y) > Interval(0.0)); },
                                   [&] { alternatives.integer("n"); }});
  EXPECT_FALSE(alternatives.is_system());
  Problem reals("reals");
  SearchOptions options;
  options.precision = 0;
  EXPECT_THROW(reals.solve_all(options), std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
