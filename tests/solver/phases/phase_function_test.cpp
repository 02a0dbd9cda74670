// SPDX-License-Identifier: Apache-2.0
// Polynomials whose coefficients are expressions, against polynomials of whole numbers in exact arithmetic.
#include "solver/phases/phase_function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "domains/rounding.h"
#include "solver/expression/program.h"
#include "solver/phases/folding.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

// The value of an expression of literals, all whole numbers and halves of them: exact.
double value_of(Expr e) {
  const RoundUpward guard;
  const Program program(e.dag(), {e.node()});
  Evaluation evaluation(program);
  evaluation.forward();
  const Interval value = evaluation.get(program.root());
  EXPECT_LE(value.width(), 1e-9);
  return value.mid();
}

struct PhaseFunctionTest : ::testing::Test {
  Dag dag;
  oracle::Dice dice;
  std::vector<Expr> durations;
  PhaseFunctionTest() {
    for (const double tau : {2.0, 0.0, 3.0}) durations.push_back(folding::number(dag, tau));
  }
  Expr whole() { return folding::number(dag, dice.below(9) - 4); }
  PhaseFunction random_hold() { return PhaseFunction::hold({whole(), whole(), whole()}); }
  PhaseFunction random_function(int degree) {
    PhaseFunction f = random_hold();
    for (int k = 0; k < degree; ++k) f = PhaseFunction::integral(durations, f, whole());
    return f;
  }
  static double at(const PhaseFunction& f, std::size_t phase, double s) {
    const LocalPolynomial& p = f.pieces()[phase].polynomial;
    return value_of(p.at(folding::number(p.coefficients[0].dag(), s)));
  }
};

TEST_F(PhaseFunctionTest, AnIntegralIsContinuousAndHasTheDerivative) {
  for (int run = 0; run < 100; ++run) {
    const PhaseFunction f = random_function(run % 4), x = PhaseFunction::integral(durations, f, whole());
    EXPECT_TRUE(x.is_continuous());
    for (std::size_t i = 0; i < 3; ++i) {
      const Piece& piece = x.pieces()[i];
      EXPECT_DOUBLE_EQ(value_of(piece.end), at(x, i, value_of(durations[i])));
      if (i + 1 < 3) {
        EXPECT_EQ(piece.end.node(), x.pieces()[i + 1].start().node());
      }
      const LocalPolynomial slope = piece.polynomial.derivative();
      for (std::size_t k = 0; k < slope.coefficients.size(); ++k)
        EXPECT_EQ(slope.coefficients[k].node(), f.pieces()[i].polynomial.coefficients[k].node());
    }
  }
}

TEST_F(PhaseFunctionTest, OperatorsArePointwise) {
  const auto apply = [](Op op, double a, double b) {
    return op == Op::add ? a + b : op == Op::sub ? a - b : op == Op::mul ? a * b : op == Op::neg ? -a : a * a;
  };
  for (int run = 0; run < 200; ++run) {
    const PhaseFunction f = random_function(run % 3), g = random_function(run % 4);
    for (const Op op : {Op::add, Op::sub, Op::mul, Op::neg, Op::sqr}) {
      const bool is_unary = op == Op::neg || op == Op::sqr;
      const auto made = PhaseFunction::apply(op, is_unary ? std::vector{f} : std::vector{f, g});
      ASSERT_TRUE(made.has_value());
      for (std::size_t i = 0; i < 3; ++i) {
        for (const double s : {0.0, 1.0, 2.5})
          EXPECT_NEAR(at(*made, i, s), apply(op, at(f, i, s), at(g, i, s)),
                      1e-6 * (1 + std::abs(at(*made, i, s))));
        EXPECT_NEAR(value_of(made->pieces()[i].end), at(*made, i, value_of(durations[i])),
                    1e-6 * (1 + std::abs(value_of(made->pieces()[i].end))));
      }
    }
  }
}

TEST_F(PhaseFunctionTest, PowersAreProducts) {
  const PhaseFunction f = random_function(2), three(durations, folding::number(dag, 3.0));
  const auto cube = PhaseFunction::apply(Op::pown, {f, three});
  ASSERT_TRUE(cube.has_value());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(at(*cube, i, 1.5), std::pow(at(f, i, 1.5), 3), 1e-6);
  EXPECT_FALSE(PhaseFunction::apply(Op::sin, {f}).has_value());
  EXPECT_TRUE(PhaseFunction::apply(Op::sin, {random_hold()}).has_value());
}

// Nothing is left of what literals make superfluous.
TEST_F(PhaseFunctionTest, APhaseThatHoldsAddsNoTerms) {
  const Expr jerk(dag, dag.input({Input::Kind::real, 0, 0, 0})),
      tau(dag, dag.input({Input::Kind::real, 1, 0, 0}));
  const Expr zero = folding::number(dag, 0.0);
  const std::vector<Expr> lengths{tau, tau};
  const PhaseFunction a = PhaseFunction::integral(lengths, PhaseFunction::hold({jerk, zero}), zero);
  EXPECT_EQ(a.pieces()[0].end.node(), (tau * jerk).node());
  EXPECT_EQ(a.pieces()[1].end.node(), (tau * jerk).node());
  EXPECT_EQ(a.pieces()[1].polynomial.degree(), 0U);
  const PhaseFunction still = PhaseFunction::integral(lengths, PhaseFunction(lengths, zero), jerk);
  EXPECT_EQ(still.constant()->node(), jerk.node());
}

TEST(Folding, KeepsWhatMayBeUndefined) {
  Dag dag;
  const Expr x(dag, dag.input({Input::Kind::real, 0, 0, 0})), zero = folding::number(dag, 0.0);
  EXPECT_EQ(folding::product(zero, x).node(), zero.node());
  EXPECT_NE(folding::product(zero, sqrt(x)).node(), zero.node());
  EXPECT_EQ(folding::difference(x, x).node(), zero.node());
  EXPECT_NE(folding::difference(log(x), log(x)).node(), zero.node());
  EXPECT_TRUE(folding::is_number(folding::equality(x, x), 1.0));
  EXPECT_FALSE(folding::is_number(folding::equality(x / x, x / x), 1.0));
}

}  // namespace
}  // namespace hcsp
