// SPDX-License-Identifier: Apache-2.0
#include "solver/search/fritz_john.h"

#include <gtest/gtest.h>

#include <random>

#include "domains/rounding.h"
#include "solver/expression/expr.h"

namespace hcsp {
namespace {

struct FritzJohnTest : ::testing::Test {
  static constexpr VariableId kUnknowns = 3;
  Dag dag;
  std::vector<System::Unknown> unknowns;
  std::vector<Expr> x;
  Input value{Input::Kind::real, kUnknowns, 0, 0};
  FritzJohnTest() {
    for (VariableId v = 0; v < kUnknowns; ++v) {
      unknowns.push_back({{Input::Kind::real, v, 0, 0}, Interval(-4.0, 4.0)});
      x.emplace_back(dag, dag.input(unknowns.back().input));
    }
  }
  bool may_hold(Expr objective, const std::vector<Expr>& relations, std::vector<Interval> box) {
    std::vector<NodeId> nodes;
    for (const Expr& relation : relations) nodes.push_back(relation.node());
    const Minimisation problem(dag, objective.node(), nodes, unknowns, value);
    const RoundUpward guard;
    box.push_back(Interval::entire());
    return FritzJohn(problem).may_hold_minimiser(box);
  }
};

// Points that satisfy the conditions, of objectives and constraints that bend, in whole numbers: exact. Some
// unknowns are at a bound of their domains.
TEST_F(FritzJohnTest, KeepsBoxesWithAPointThatSatisfiesThem) {
  std::mt19937_64 random(40);
  std::uniform_int_distribution<int> small(-3, 3), positive(0, 3), where(-3, 3), choice(0, 3);
  std::uniform_real_distribution<double> width(0.0, 1.0);
  for (int k = 0; k < 3000; ++k) {
    std::vector<int> best(kUnknowns), gradient(kUnknowns);
    std::vector<Interval> box;
    for (std::size_t v = 0; v < kUnknowns; ++v) {
      best[v] = where(random);
      const int at = choice(random);  // 0: the lower bound of the domain, 1: the upper one
      unknowns[v].domain = Interval(at == 0 ? best[v] : -4.0, at == 1 ? best[v] : 4.0);
      gradient[v] = at == 0 ? positive(random) : at == 1 ? -positive(random) : 0;
      box.push_back(meet(Interval(best[v] - width(random), best[v] + width(random)), unknowns[v].domain));
    }
    const auto bent = [&](std::size_t v) {
      const Expr offset = x[v] - Interval(best[v]);
      return choice(random) < 2 ? Interval(small(random)) * sqr(offset)
                                : Interval(small(random)) * offset *
                                      (x[(v + 1) % kUnknowns] - Interval(best[(v + 1) % kUnknowns]));
    };
    std::vector<Expr> relations;
    for (int row = 0; row < 2; ++row) {
      const bool is_equation = choice(random) == 0;
      const int multiplier = is_equation ? small(random) : positive(random);
      Expr left = bent(0);
      for (std::size_t v = 0; v < kUnknowns; ++v) {
        const int slope = small(random);
        left = left + Interval(slope) * (x[v] - Interval(best[v])) + bent(v);
        gradient[v] -= multiplier * slope;
      }
      relations.push_back(is_equation ? left == Interval(0.0) : left <= Interval(0.0));
    }
    Expr objective = bent(1);
    for (std::size_t v = 0; v < kUnknowns; ++v)
      objective = objective + Interval(gradient[v]) * x[v] + bent(v);
    ASSERT_TRUE(may_hold(objective, relations, box)) << "case " << k;
  }
}

TEST_F(FritzJohnTest, RefutesBoxesWithout) {
  const Expr circle = sqr(x[0]) + sqr(x[1]);
  const auto near = [](double a, double b) {
    return std::vector<Interval>{Interval(a - 0.01, a + 0.01), Interval(b - 0.01, b + 0.01),
                                 Interval(-1.0, 1.0)};
  };
  const double root = 0.70710678;
  EXPECT_TRUE(may_hold(x[0] + x[1], {circle == Interval(1.0)}, near(-root, -root)));
  EXPECT_FALSE(may_hold(x[0] + x[1], {circle == Interval(1.0)}, near(0.6, 0.8)));
  // Of an inequality the multiplier has a sign.
  EXPECT_TRUE(may_hold(x[0] + x[1], {circle <= Interval(1.0)}, near(-root, -root)));
  EXPECT_FALSE(may_hold(x[0] + x[1], {circle <= Interval(1.0)}, near(root, root)));
  // A slope that only goes down ends at the bound of a domain.
  EXPECT_FALSE(may_hold(x[0] + sqr(x[1]), {}, near(0.0, 0.0)));
  EXPECT_TRUE(may_hold(x[0] + sqr(x[1]), {}, near(-4.0, 0.0)));
  EXPECT_FALSE(may_hold(x[0] + sqr(x[1]), {}, near(4.0, 0.0)));
  // A kink may be a minimum.
  EXPECT_TRUE(may_hold(abs(x[0]) + sqr(x[1]), {}, near(0.0, 0.0)));
  EXPECT_FALSE(may_hold(abs(x[0]) + sqr(x[1]), {}, near(1.0, 0.0)));
}

// Far out nothing is refuted, nor where a function ends.
TEST_F(FritzJohnTest, RefutesNothingWhereTheConditionsNeedNotHold) {
  for (System::Unknown& unknown : unknowns) unknown.domain = Interval::entire();
  std::vector<Interval> box(kUnknowns, Interval(1.0, 2.0));
  EXPECT_FALSE(may_hold(-x[0], {}, box));
  box[0] = Interval::raw(1.0, kInfinity);
  EXPECT_TRUE(may_hold(-x[0], {}, box));
  EXPECT_TRUE(
      may_hold(x[0], {sqrt(x[0]) >= Interval(0.0)}, std::vector<Interval>(kUnknowns, Interval(0.0, 1.0))));
}

}  // namespace
}  // namespace hcsp
