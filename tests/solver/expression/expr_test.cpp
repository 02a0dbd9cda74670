// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/expr.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hcsp {
namespace {

class ExprTest : public ::testing::Test {
 protected:
  Expr leaf(VariableId v) { return {dag, dag.input({Input::Kind::real, v, 0, 0})}; }
  void expect_node(Expr e, Op op, std::vector<Expr> operands) {
    ASSERT_EQ(dag[e.node()].op, op);
    for (std::size_t k = 0; k < operands.size(); ++k)
      EXPECT_EQ(dag[e.node()].operands[k], operands[k].node()) << k;
  }
  Dag dag;
  Expr a = leaf(0), b = leaf(1), c = leaf(2);
};

TEST_F(ExprTest, OperatorsBuildWhatTheySay) {
  expect_node(-a, Op::neg, {a});
  expect_node(a + b, Op::add, {a, b});
  expect_node(a - b, Op::sub, {a, b});
  expect_node(a * b, Op::mul, {a, b});
  expect_node(a / b, Op::div, {a, b});
  expect_node(sqr(a), Op::sqr, {a});
  expect_node(a * a, Op::sqr, {a});
  expect_node(sqrt(a), Op::sqrt, {a});
  expect_node(abs(a), Op::abs, {a});
  expect_node(min(a, b), Op::min, {a, b});
  expect_node(max(a, b), Op::max, {a, b});
  expect_node(sin(a), Op::sin, {a});
  expect_node(cos(a), Op::cos, {a});
  expect_node(atan2(a, b), Op::atan2, {a, b});
  expect_node(if_then_else(a < b, b, c), Op::if_then_else, {a < b, b, c});
}

TEST_F(ExprTest, RelationsAndConnectivesBuildWhatTheySay) {
  expect_node(a < b, Op::less, {a, b});
  expect_node(a > b, Op::less, {b, a});
  expect_node(a <= b, Op::less_equal, {a, b});
  expect_node(a >= b, Op::less_equal, {b, a});
  expect_node(a == b, Op::equal, {a, b});
  expect_node(a != b, Op::not_equal, {a, b});
  const Expr p = a < b, q = b < c;
  expect_node(p && q, Op::logical_and, {p, q});
  expect_node(p || q, Op::logical_or, {p, q});
  expect_node(!p, Op::logical_not, {p});
}

TEST_F(ExprTest, ConstantsStandOnEitherSide) {
  const Expr two{dag, dag.constant(Interval(2))}, range{dag, dag.constant(Interval(1, 2))};
  expect_node(a + 2.0, Op::add, {a, two});
  expect_node(2.0 - a, Op::sub, {two, a});
  expect_node(Interval(1, 2) * a, Op::mul, {range, a});
  expect_node(a / 2.0, Op::div, {a, two});
  expect_node(2.0 < a, Op::less, {two, a});
  expect_node(2.0 > a, Op::less, {a, two});
  expect_node(a >= 2.0, Op::less_equal, {two, a});
  expect_node(a == Interval(1, 2), Op::equal, {a, range});
  expect_node(a != 2.0, Op::not_equal, {a, two});
}

TEST_F(ExprTest, VectorsActComponentByComponent) {
  const VectorExpr u{a, b}, v{b, c};
  EXPECT_EQ((u + v)[1].node(), (b + c).node());
  EXPECT_EQ((u - v)[0].node(), (a - b).node());
  EXPECT_EQ((c * u)[0].node(), (c * a).node());
  EXPECT_EQ(dot(u, v).node(), (a * b + b * c).node());
  EXPECT_EQ(norm(u).node(), sqrt(sqr(a) + sqr(b)).node());
  EXPECT_EQ((u == v).node(), (a == b && b == c).node());
}

TEST_F(ExprTest, SizesMustAgree) {
  const VectorExpr u{a, b}, v{a, b, c};
  EXPECT_THROW(u + v, std::invalid_argument);
  EXPECT_THROW(u - v, std::invalid_argument);
  EXPECT_THROW(dot(u, v), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(u == v), std::invalid_argument);
  EXPECT_THROW(norm({}), std::invalid_argument);
}

TEST_F(ExprTest, SystemsDoNotMix) {
  Dag other;
  const Expr stranger{other, other.input({Input::Kind::real, 0, 0, 0})};
  EXPECT_THROW(a + stranger, std::invalid_argument);
  EXPECT_THROW(if_then_else(a < b, b, stranger), std::invalid_argument);
  EXPECT_THROW(operate(Op::add, {}), std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
