// SPDX-License-Identifier: Apache-2.0
#include "solver/search/feasible_point.h"

#include <gtest/gtest.h>

#include "domains/rounding.h"
#include "solver/expression/expr.h"

namespace hcsp {
namespace {

struct FeasiblePointTest : ::testing::Test {
  Dag dag;
  std::vector<System::Unknown> unknowns;
  std::vector<Expr> x;
  FeasiblePointTest() {
    for (VariableId v = 0; v < 3; ++v) {
      unknowns.push_back({{Input::Kind::real, v, 0, 0}, Interval(0.0, 10.0)});
      x.emplace_back(dag, dag.input(unknowns.back().input));
    }
  }
  System system(const std::vector<Expr>& relations) {
    std::vector<NodeId> nodes;
    for (const Expr& relation : relations) nodes.push_back(relation.node());
    return {dag, nodes, unknowns};
  }
  static std::vector<Interval> found(const System& system, const std::vector<double>& near) {
    const RoundUpward guard;
    FeasiblePoint feasible(system);
    return feasible.find(near) ? feasible.box() : std::vector<Interval>{};
  }
};

TEST_F(FeasiblePointTest, IsMovedOntoWhatItViolates) {
  const System less = system({sqr(x[0]) + sqr(x[1]) <= Interval(2.0), x[0] >= Interval(0.5)});
  const auto near = found(less, {1.0 + 1e-7, 1.0 + 1e-7, 5.0});
  ASSERT_EQ(near.size(), 3U);
  EXPECT_LE((sqr(near[0]) + sqr(near[1])).hi(), 2.0);
  EXPECT_NEAR(near[0].lo(), 1.0, 1e-6);
}

TEST_F(FeasiblePointTest, HoldsAnExactSolutionOfEquations) {
  const System curve = system({x[0] * x[1] == Interval(2.0), exp(x[2]) == x[0] + x[1]});
  const auto box = found(curve, {1.5, 1.2, 1.1});
  ASSERT_EQ(box.size(), 3U);
  EXPECT_TRUE((box[0] * box[1]).contains(2.0));
  EXPECT_LE(box[0].width() + box[1].width() + box[2].width(), 1e-12);
}

// At a bound of its domain an unknown is fixed, and another solves the equation.
TEST_F(FeasiblePointTest, StaysInTheDomains) {
  const System sum = system({x[0] + x[1] + x[2] == Interval(10.0)});
  const auto box = found(sum, {10.0, 1e-12, 0.0});
  ASSERT_EQ(box.size(), 3U);
  for (const Interval& side : box) EXPECT_TRUE(leq(side, Interval(0.0, 10.0)));
  const System product = system({x[0] * x[1] == Interval(0.0), x[1] + x[2] == Interval(4.0)});
  EXPECT_EQ(found(product, {1e-13, 2.0, 2.0}).size(), 3U);
}

TEST_F(FeasiblePointTest, EquationsThatOthersImplyNeedNoProof) {
  const System same =
      system({x[0] + x[1] == Interval(3.0), x[1] + x[2] == Interval(4.0), x[0] - x[2] == Interval(-1.0)});
  EXPECT_EQ(found(same, {1.0, 2.0, 2.0}).size(), 3U);
  const RoundUpward guard;
  EXPECT_EQ(implied_equations(same), (std::vector<std::uint8_t>{0, 0, 1}));
  const System apart =
      system({x[0] + x[1] == Interval(3.0), x[1] + x[2] == Interval(4.0), x[0] - x[2] == Interval(-1.5)});
  EXPECT_EQ(implied_equations(apart), (std::vector<std::uint8_t>{0, 0, 0}));
  const System thirds = system({x[0] / Interval(3.0) == Interval(1.0), x[0] == Interval(3.0)});
  EXPECT_EQ(implied_equations(thirds), (std::vector<std::uint8_t>{0, 0}));
}

TEST_F(FeasiblePointTest, WholeNumbersAreWhole) {
  unknowns[0].is_whole = true;
  const System some = system({x[0] + x[1] == Interval(2.5)});
  const auto box = found(some, {1.2, 1.3, 0.0});
  ASSERT_EQ(box.size(), 3U);
  EXPECT_EQ(box[0], Interval(1.0));
  EXPECT_TRUE(box[1].contains(1.5));
  EXPECT_TRUE(found(system({x[0] == Interval(2.5)}), {2.5, 0.0, 0.0}).empty());
}

TEST_F(FeasiblePointTest, NothingThatOnlyTouchesIsProven) {
  EXPECT_TRUE(found(system({sqr(x[0] - Interval(1.0)) == Interval(0.0)}), {1.1, 0.0, 0.0}).empty());
  EXPECT_TRUE(found(system({sqrt(x[0]) + x[1] == Interval(-1.0)}), {0.0, 0.0, 0.0}).empty());
}

}  // namespace
}  // namespace hcsp
