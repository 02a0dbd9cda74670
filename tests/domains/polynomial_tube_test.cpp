// SPDX-License-Identifier: Apache-2.0
#include "domains/polynomial_tube.h"

#include <gtest/gtest.h>

#include "tests/support/oracle.h"

namespace hcsp {
namespace {

double at(const std::vector<double>& c, double s) {
  double value = 0.0, factor = 1.0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    value += c[k] * factor;
    factor *= s / static_cast<double>(k + 1);
  }
  return value;
}

// Polynomials and durations drawn from the intervals: every value is enclosed, wherever it is asked for.
TEST(PolynomialTube, EnclosesWhatItsIntervalsHold) {
  oracle::for_seeds(200, [](oracle::Dice& dice) {
    std::vector<Interval> durations, instants{Interval(0.0)};
    std::vector<double> lengths, starts{0.0};
    PolynomialTube::Component component;
    std::vector<std::vector<double>> polynomials;
    const int phases = 1 + dice.below(3);
    for (int i = 0; i < phases; ++i) {
      lengths.push_back(oracle::dyadic(dice, 0, 2));
      starts.push_back(starts.back() + lengths.back());
      durations.emplace_back(std::max(0.0, lengths.back() - oracle::dyadic(dice, 0, 0.5)),
                             lengths.back() + oracle::dyadic(dice, 0, 0.5));
      instants.push_back(instants.back() + durations.back());
      std::vector<Interval> coefficients;
      std::vector<double>& polynomial = polynomials.emplace_back();
      const int degree = dice.below(4);
      for (int k = 0; k <= degree; ++k) {
        polynomial.push_back(oracle::dyadic(dice, -3, 3));
        coefficients.emplace_back(polynomial.back() - oracle::dyadic(dice, 0, 0.25),
                                  polynomial.back() + oracle::dyadic(dice, 0, 0.25));
      }
      component.coefficients.push_back(coefficients);
    }
    component.gates.assign(static_cast<std::size_t>(phases) + 1, Interval::entire());
    const PolynomialTube tube(durations, instants, {component});
    constexpr double kRounding = 1e-12;  // of the doubles that the test computes with
    for (std::size_t i = 0; i < static_cast<std::size_t>(phases); ++i) {
      for (int run = 0; run < 20; ++run) {
        const double s = lengths[i] * dice.below(17) / 16.0;
        const double value = at(polynomials[i], s);
        const Interval around(value - kRounding, value + kRounding);
        EXPECT_FALSE(meet(tube.slice(0, i), around).is_empty());
        EXPECT_FALSE(meet(tube.at(0, Interval(starts[i] + s)), around).is_empty());
      }
    }
  });
}

// Of exact coefficients the range is as good as exact, with a maximum inside or without.
TEST(PolynomialTube, RangesAreTight) {
  const PolynomialTube tube(
      {Interval(2.0)}, {Interval(0.0), Interval(2.0)},
      {{{{Interval(0.0), Interval(1.0), Interval(-1.0)}}, {Interval(0.0), Interval(0.0)}}});
  EXPECT_TRUE(leq(Interval(0.0, 0.5), tube.slice(0, 0)));
  EXPECT_LE(tube.slice(0, 0).width(), 0.502);
  EXPECT_TRUE(tube.at(0, Interval(2.5, 3.0)).is_empty());
  EXPECT_EQ(tube.degree(), 2U);
  EXPECT_FALSE(tube.is_empty());
  EXPECT_TRUE(bottom(tube).is_empty());
  EXPECT_TRUE(leq(bottom(tube), tube) && leq(tube, tube) && !leq(tube, bottom(tube)));
}

TEST(PolynomialTube, RefusesShapesThatDoNotFit) {
  EXPECT_THROW(PolynomialTube({Interval(1.0)}, {Interval(0.0)}, {}), std::invalid_argument);
  EXPECT_THROW(PolynomialTube({Interval(1.0)}, {Interval(0.0), Interval(1.0)}, {{{}, {}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
