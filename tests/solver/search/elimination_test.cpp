// SPDX-License-Identifier: Apache-2.0
#include "solver/search/elimination.h"

#include <gtest/gtest.h>

#include "domains/rounding.h"
#include "solver/expression/expr.h"

namespace hcsp {
namespace {

struct EliminationTest : ::testing::Test {
  Dag dag;
  std::vector<System::Unknown> unknowns;
  std::vector<Expr> x;
  EliminationTest() {
    for (VariableId v = 0; v < 3; ++v) {
      unknowns.push_back({{Input::Kind::real, v, 0, 0}, Interval::entire()});
      x.emplace_back(dag, dag.input(unknowns.back().input));
    }
  }
  System system(const std::vector<Expr>& relations) {
    std::vector<NodeId> nodes;
    for (const Expr& relation : relations) nodes.push_back(relation.node());
    return {dag, nodes, unknowns};
  }
  static bool contract(const System& system, std::vector<Interval>& box) {
    const RoundUpward guard;
    MeanValueForms forms(system);
    return Elimination(forms).contract(box);
  }
};

TEST_F(EliminationTest, SolvesWhatIsLinearOnWideBoxes) {
  const System linear =
      system({x[0] + x[1] + x[2] == Interval(6.0), x[0] - x[1] == Interval(-1.0),
              x[0] + Interval(2.0) * x[1] - x[2] == Interval(2.0), x[0] * x[1] * x[2] == Interval(6.0)});
  std::vector<Interval> box(3, Interval(-1e6, 1e6));
  ASSERT_TRUE(contract(linear, box));
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_TRUE(box[v].contains(static_cast<double>(v + 1)));
    EXPECT_LT(box[v].width(), 1e-6);
  }
}

TEST_F(EliminationTest, ProvesThatLinearEquationsDisagree) {
  const System linear =
      system({x[0] + x[1] == Interval(1.0), x[1] + x[2] == Interval(2.0), x[0] - x[2] == Interval(5.0)});
  std::vector<Interval> box(3, Interval(-100.0, 100.0));
  EXPECT_FALSE(contract(linear, box));
}

// An equation without a mean value form is left out.
TEST_F(EliminationTest, LeavesOutWhatHasNoSlope) {
  const System some = system(
      {sqrt(x[0]) + x[1] == Interval(1.0), x[1] + x[2] == Interval(2.0), x[1] - x[2] == Interval(0.0)});
  std::vector<Interval> box(3, Interval(-100.0, 100.0));
  ASSERT_TRUE(contract(some, box));
  EXPECT_EQ(box[0], Interval(-100.0, 100.0));
  EXPECT_LT(box[1].width(), 1e-12);
  box[1] = Interval::entire();
  EXPECT_TRUE(contract(some, box));
}

}  // namespace
}  // namespace hcsp
