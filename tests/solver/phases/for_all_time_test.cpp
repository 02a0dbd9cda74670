// SPDX-License-Identifier: Apache-2.0
// What "for every t" becomes, against values at many instants.
#include "solver/phases/for_all_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "domains/rounding.h"
#include "solver/expression/operators.h"
#include "solver/expression/program.h"
#include "solver/phases/folding.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

// The coefficients of s^k/k! as a polynomial of plain numbers.
double at(const std::vector<double>& coefficients, double s) {
  double value = 0.0, power = 1.0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    value += coefficients[k] * power;
    power *= s / static_cast<double>(k + 1);
  }
  return value;
}

double greatest(const std::vector<double>& coefficients, double duration) {
  constexpr int kSteps = 4000;
  double most = -kInfinity;
  for (int i = 0; i <= kSteps; ++i) most = std::max(most, at(coefficients, duration * i / kSteps));
  return most;
}

// Whether relations between literals all hold: certainly, certainly not, or neither is told.
enum class Told { yes, no, unknown };
Told told(Dag& dag, const std::vector<Expr>& relations) {
  const RoundUpward guard;
  const Expr all = folding::conjunction(dag, relations);
  const Program program(dag, {all.node()});
  Evaluation evaluation(program);
  evaluation.forward();
  const Interval truth = evaluation.get(program.root());
  return truth == kTrue ? Told::yes : truth == kFalse ? Told::no : Told::unknown;
}

struct Case {
  Dag dag;
  std::vector<Expr> durations;
  PhaseFunction f;
  Case(const std::vector<double>& coefficients, double duration)
      : durations{folding::number(dag, duration)}, f(made(coefficients)) {}
  PhaseFunction made(const std::vector<double>& coefficients) {
    LocalPolynomial p;
    for (const double c : coefficients) p.coefficients.push_back(folding::number(dag, c));
    while (p.degree() > 0 && folding::is_number(p.coefficients.back(), 0.0)) p.coefficients.pop_back();
    return PhaseFunction({{p, p.at(durations[0])}}, true);
  }
  Told is_below(double bound, bool strict = false) {
    const PhaseFunction limit(durations, folding::number(dag, bound));
    return told(dag, *less_for_all_time(durations, f, limit, strict));
  }
};

// Just above the greatest value the relation holds, just below it does not.
TEST(ForAllTime, ABoundHoldsExactlyFromTheGreatestValueOn) {
  oracle::for_seeds(400, [](oracle::Dice& dice) {
    std::vector<double> coefficients;
    const int degree = dice.below(4);
    for (int k = 0; k <= degree; ++k) coefficients.push_back((dice.below(13) - 6) / 2.0);
    const double duration = dice.below(13) / 4.0;
    Case of(coefficients, duration);
    const double most = greatest(coefficients, duration);
    const double margin = 1e-4 * (1.0 + std::abs(most));
    for (const bool strict : {false, true}) {
      EXPECT_NE(of.is_below(most + margin, strict), Told::no);
      EXPECT_NE(of.is_below(most - margin, strict), Told::yes);
      EXPECT_EQ(of.is_below(most - 0.5, strict), Told::no) << most;
    }
  });
}

TEST(ForAllTime, APeakBetweenTheGatesCounts) {
  Case parabola({0.0, 1.0, -1.0}, 2.0);  // s - s^2/2: 1/2 at s = 1, 0 at both ends
  EXPECT_EQ(parabola.is_below(0.25), Told::no);
  EXPECT_EQ(parabola.is_below(0.5), Told::yes);
  EXPECT_EQ(parabola.is_below(0.5, true), Told::no);
  EXPECT_EQ(parabola.is_below(0.625, true), Told::yes);
  Case cubic({0.0, 0.0, 6.0, -6.0}, 3.0);  // 3 s^2 - s^3: 4 at s = 2, 0 at both ends
  EXPECT_EQ(cubic.is_below(3.5), Told::no);
  EXPECT_EQ(cubic.is_below(4.5), Told::yes);
}

TEST(ForAllTime, DegreesAboveThreeAreNotDecided) {
  Case quartic({0.0, 0.0, 0.0, 0.0, 1.0}, 1.0);
  const PhaseFunction zero(quartic.durations, folding::number(quartic.dag, 0.0));
  EXPECT_FALSE(less_for_all_time(quartic.durations, quartic.f, zero, false).has_value());
}

TEST(ForAllTime, EqualFunctionsHaveEqualCoefficients) {
  Case one({1.0, 2.0, 3.0}, 2.0);
  EXPECT_EQ(told(one.dag, equal_for_all_time(one.f, one.made({1.0, 2.0, 3.0}))), Told::yes);
  EXPECT_EQ(told(one.dag, equal_for_all_time(one.f, one.made({1.0, 2.0, 3.0, 0.5}))), Told::no);
  EXPECT_EQ(told(one.dag, equal_for_all_time(one.f, one.made({1.0, 2.0}))), Told::no);
  EXPECT_EQ(told(one.dag, derivative_for_all_time(one.f, one.made({2.0, 3.0}))), Told::yes);
  EXPECT_EQ(told(one.dag, derivative_for_all_time(one.f, one.made({2.0, 4.0}))), Told::no);
}

// What jumps has no derivative.
TEST(ForAllTime, ADerivativeMakesContinuous) {
  Dag dag;
  const std::vector<Expr> durations{folding::number(dag, 1.0), folding::number(dag, 1.0)};
  const Expr one = folding::number(dag, 1.0), two = folding::number(dag, 2.0);
  const PhaseFunction zero(durations, folding::number(dag, 0.0));
  EXPECT_EQ(told(dag, derivative_for_all_time(PhaseFunction::hold({one, two}), zero)), Told::no);
  EXPECT_EQ(told(dag, derivative_for_all_time(PhaseFunction::hold({two, two}), zero)), Told::yes);
}

}  // namespace
}  // namespace hcsp
