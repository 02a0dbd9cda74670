// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/relation.h"

#include <gtest/gtest.h>

#include "tests/support/pointwise.h"

namespace hcsp {
namespace {

using oracle::Answer;
using oracle::check_constraint;
using oracle::Dice;
using oracle::for_seeds;
using oracle::Point;

std::function<Point(Dice&)> dyadics(std::size_t dim) {
  return [dim](Dice& dice) {
    Point point;
    for (std::size_t i = 0; i < dim; ++i) point.push_back(oracle::dyadic(dice, -4, 4, 1));
    return point;
  };
}

Answer of(bool holds) { return holds ? Answer::yes : Answer::no; }

// In these cases the arithmetic on half-integers is exact, so the predicate is exact.
TEST(RelationContractor, Sum) {
  check_constraint({3, [](const Point& x) { return of(x[0] + x[1] == x[2]); },
                    [](Problem& p, const auto& x) { p.constrain("sum", p(x[0]) + p(x[1]) == p(x[2])); },
                    dyadics(3)});
}

TEST(RelationContractor, Product) {
  check_constraint({3, [](const Point& x) { return of(x[0] * x[1] == x[2]); },
                    [](Problem& p, const auto& x) { p.constrain("product", p(x[0]) * p(x[1]) == p(x[2])); },
                    [](Dice& dice) {
                      Point x = dyadics(2)(dice);
                      x.push_back(x[0] * x[1]);
                      return x;
                    }});
}

TEST(RelationContractor, DiscAndLine) {
  check_constraint({2, [](const Point& x) { return of(x[0] * x[0] + x[1] * x[1] <= 9 && x[1] > x[0]); },
                    [](Problem& p, const auto& x) {
                      p.constrain("disc", sqr(p(x[0])) + sqr(p(x[1])) <= 9.0);
                      p.constrain("line", p(x[1]) > p(x[0]));
                    },
                    dyadics(2)});
}

TEST(RelationContractor, Disjunction) {
  check_constraint({2,
                    [](const Point& x) {
                      return of((x[0] >= 2 && x[1] <= 1) || std::max(x[0], x[1]) == 0.5 || x[0] == -1);
                    },
                    [](Problem& p, const auto& x) {
                      p.constrain("or", (p(x[0]) >= 2.0 && p(x[1]) <= 1.0) || max(p(x[0]), p(x[1])) == 0.5 ||
                                            p(x[0]) == -1.0);
                    },
                    dyadics(2)});
}

TEST(RelationContractor, NegationOfAPartialTerm) {
  check_constraint({2, [](const Point& x) { return of(!(x[0] >= 0 && x[1] > 0 && x[0] < x[1] * x[1])); },
                    [](Problem& p, const auto& x) { p.constrain("not", !(sqrt(p(x[0])) < p(x[1]))); },
                    dyadics(2)});
}

TEST(RelationContractor, Choice) {
  check_constraint({2, [](const Point& x) { return of((x[0] < 0 ? -x[0] : 2 * x[0]) == x[1]); },
                    [](Problem& p, const auto& x) {
                      p.constrain("if", if_then_else(p(x[0]) < 0.0, -p(x[0]), 2.0 * p(x[0])) == p(x[1]));
                    },
                    dyadics(2)});
}

// Any relation at all, its predicate by recursion.
TEST(RelationContractor, RandomSystems) {
  int found = 0;
  for_seeds(400, [&](Dice& dice) {
    const int how = dice.below(1 << 20);
    const auto build_relations = [how](const std::vector<Expr>& leaves) {
      Dice same(static_cast<std::uint64_t>(how));
      return std::vector{oracle::random_relation(same, leaves, 3), oracle::random_relation(same, leaves, 2)};
    };
    Dag dag;
    std::vector<Expr> leaves;
    for (VariableId v = 0; v < 3; ++v) leaves.emplace_back(dag, dag.input({Input::Kind::real, v, 0, 0}));
    const auto relations = build_relations(leaves);
    Point point;
    std::map<Input, double> inputs;
    Answer holds = Answer::no;
    for (int tries = 0; tries < 60 && holds != Answer::yes; ++tries) {
      point = dyadics(3)(dice);
      for (VariableId v = 0; v < 3; ++v) inputs[{Input::Kind::real, v, 0, 0}] = point[v];
      holds = Answer::yes;
      for (const Expr& relation : relations) {
        holds = std::min(holds, oracle::Pointwise(dag, inputs).holds(relation.node()));
      }
    }
    Box box(3);
    for (Eigen::Index i = 0; i < 3; ++i) box[i] = oracle::around(dice, point[static_cast<std::size_t>(i)]);
    const oracle::Build build = [&](Problem& p) {
      std::vector<Expr> terms;
      for (Eigen::Index i = 0; i < 3; ++i) terms.push_back(p(p.real("x" + std::to_string(i), box[i])));
      for (const Expr& relation : build_relations(terms)) p.constrain("relation", relation);
    };
    Problem problem("random");
    build(problem);
    PropagationOptions options;  // slow convergence is no error here: an early end is guaranteed too
    int ticks = 0;
    options.clock = [&] { return static_cast<double>(++ticks); };
    options.time_limit = 3000;
    const Result result = problem.propagate(options);
    if (holds != Answer::yes) return;
    ++found;
    ASSERT_NE(result.status, Status::infeasible);
    EXPECT_TRUE(oracle::is_within(point, oracle::box_of(result))) << to_string(oracle::box_of(result));
    if (result.status == Status::contracted) oracle::expect_order_independent(build);
  });
  EXPECT_TRUE(found > 100 || ::testing::GTEST_FLAG(random_seed) > 0 || HasFailure());
}

// A relation with a tube in it holds at every item, on its own.
TEST(RelationContractor, HoldsAtEveryItemOfTheTimeLine) {
  for_seeds(60, [](Dice& dice) {
    const std::size_t slices = 1 + static_cast<std::size_t>(dice.below(100));
    std::vector<double> instants{0.0};
    for (std::size_t k = 0; k < slices; ++k) instants.push_back(instants.back() + 0.5);
    const auto line = std::make_shared<const TimeLine>(instants);
    Tube domain(line, 2);
    for (std::size_t item = 0; item < domain.items(); ++item) {
      for (std::size_t c = 0; c < 2; ++c) domain.set(c, item, oracle::around(dice, 0.5));
    }
    const Interval bound = oracle::around(dice, 2.0);
    Problem problem("timed");
    problem.set_time_line(*line);
    const auto x = problem.tube("x", domain);
    const auto k = problem.real("k", bound);
    problem.constrain("relation", problem(x)[0] + problem(x)[1] <= problem.time() + problem(k));
    const Result result = problem.propagate();
    ASSERT_EQ(result.status, Status::contracted) << "x = (0.5, 0.5) and k = 2 is a solution";
    const Tube& tube = std::get<Tube>(result["x"]);
    const Interval left = std::get<Interval>(result["k"]);
    // The same by hand: k is bounded below at each item, then x above.
    Interval expected = bound;
    for (std::size_t item = 0; item < domain.items(); ++item) {
      const Interval room = domain.at(0, item) + domain.at(1, item) - line->span(item);
      expected = meet(expected, Interval::raw(room.lo(), kInfinity));
    }
    EXPECT_EQ(left, expected);
    for (std::size_t item = 0; item < domain.items(); ++item) {
      const Interval sum = Interval::raw(-kInfinity, (line->span(item) + left).hi());
      EXPECT_EQ(tube.at(0, item), meet(domain.at(0, item), sum - domain.at(1, item)));
    }
  });
}

TEST(RelationContractor, TheValueAtAnInstantIsTheGateAlone) {
  Problem problem("gate");
  problem.set_time_line(TimeLine({0.0, 1.0, 2.0}));
  const auto x = problem.tube("x", 1);
  problem.constrain("at 1", problem.at(x, 1.0)[0] == 3.0);
  const Tube tube = std::get<Tube>(problem.propagate()["x"]);
  for (std::size_t item = 0; item < 5; ++item) {
    EXPECT_EQ(tube.at(0, item), item == 2 ? Interval(3) : Interval::entire());
  }
}

TEST(RelationContractor, AnInfeasibleInstantIsTold) {
  Problem problem("gate");
  problem.set_time_line(TimeLine({0.0, 1.0, 2.0, 3.0}));
  const auto x = problem.tube("x", 1), y = problem.tube("y", 1);
  problem.constrain("at 2", problem.at(x, 2.0)[0] == 3.0);
  problem.constrain("at 2 again", problem.at(x, 2.0)[0] == 4.0);
  const Result result = problem.propagate();
  ASSERT_EQ(result.status, Status::infeasible);
  ASSERT_TRUE(result.explanation.has_value());
  EXPECT_EQ(result.explanation->variable, "x");
  EXPECT_EQ(result.explanation->time, (std::array{2.0, 2.0}));
  static_cast<void>(y);
}

TEST(RelationContractor, AnInfeasibleItemIsTold) {
  Problem problem("item");
  problem.set_time_line(TimeLine({0.0, 1.0, 2.0, 3.0}));
  const auto x = problem.tube("x", 1);
  problem.constrain("early", problem(x)[0] <= 1.0 - problem.time());
  problem.constrain("late", problem(x)[0] >= -1.0);
  const Result result = problem.propagate();
  ASSERT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.explanation->time, (std::array{3.0, 3.0})) << "at 3, x would have to be below -2";
}

TEST(RelationContractor, ARelationOfConstantsIsDecided) {
  Problem holds("holds"), fails("fails");
  holds.real("x", {0, 1});
  fails.real("x", {0, 1});
  holds.constrain("1 < 2", holds.constant(1) < holds.constant(2));
  fails.constrain("2 < 1", fails.constant(2) < fails.constant(1));
  EXPECT_EQ(holds.propagate().status, Status::contracted);
  const Result result = fails.propagate();
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.explanation->constraint, "2 < 1");
}

}  // namespace
}  // namespace hcsp
