// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/dag.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hcsp {
namespace {

Input real(VariableId v) { return {Input::Kind::real, v, 0, 0}; }

TEST(Dag, SharesEqualNodes) {
  Dag dag;
  const NodeId x = dag.input(real(0)), y = dag.input(real(1));
  EXPECT_EQ(dag.input(real(0)), x);
  EXPECT_NE(x, y);
  const NodeId sum = dag.apply(Op::add, {x, y}, 2);
  EXPECT_EQ(dag.apply(Op::add, {x, y}, 2), sum);
  EXPECT_NE(dag.apply(Op::sub, {x, y}, 2), sum);
  EXPECT_NE(dag.apply(Op::add, {y, x}, 2), sum);
  EXPECT_EQ(dag.constant(Interval(1, 2)), dag.constant(Interval(1, 2)));
  EXPECT_NE(dag.constant(Interval(1, 2)), dag.constant(Interval(1, 3)));
  EXPECT_NE(dag.constant(Interval(0)), x);
}

TEST(Dag, InputsDifferInEveryPart) {
  Dag dag;
  const Input inputs[] = {{Input::Kind::tube, 1, 0, 0}, {Input::Kind::tube, 1, 1, 0},
                          {Input::Kind::tube, 2, 0, 0}, {Input::Kind::gate, 1, 0, 0},
                          {Input::Kind::gate, 1, 0, 3}, {Input::Kind::point, 1, 0, 0}};
  for (const Input& input : inputs) dag.input(input);
  EXPECT_EQ(dag.size(), std::size(inputs));
}

TEST(Dag, ChildrenPrecedeParents) {
  Dag dag;
  const NodeId x = dag.input(real(0));
  const NodeId root = dag.apply(Op::less, {dag.apply(Op::sin, {x}, 1), dag.constant(Interval(0))}, 2);
  for (const NodeId operand : {dag[root].operands[0], dag[root].operands[1]}) EXPECT_LT(operand, root);
}

TEST(Dag, AProductOfANodeWithItselfIsASquare) {
  Dag dag;
  const NodeId x = dag.input(real(0)), y = dag.input(real(1));
  const NodeId square = dag.apply(Op::mul, {x, x}, 2);
  EXPECT_EQ(dag[square].op, Op::sqr);
  EXPECT_EQ(square, dag.apply(Op::sqr, {x}, 1));
  EXPECT_EQ(dag[dag.apply(Op::mul, {x, y}, 2)].op, Op::mul);
}

TEST(Dag, WrongArityThrows) {
  Dag dag;
  const NodeId x = dag.input(real(0));
  EXPECT_THROW(dag.apply(Op::add, {x}, 1), std::invalid_argument);
  EXPECT_THROW(dag.apply(Op::sin, {x, x}, 2), std::invalid_argument);
  EXPECT_THROW(dag.apply(Op::if_then_else, {x, x}, 2), std::invalid_argument);
  EXPECT_THROW(dag.apply(Op::constant, {}, 0), std::invalid_argument);
  EXPECT_THROW(dag.apply(Op::input, {x}, 1), std::invalid_argument);
  EXPECT_THROW(dag.apply(Op::neg, {x + 1}, 1), std::invalid_argument) << "no such node";
}

}  // namespace
}  // namespace hcsp
