// SPDX-License-Identifier: Apache-2.0
// sin, cos, atan2 bit for bit against MPFR at points and over intervals; their reverses on sampled solutions,
// for isotony, and against known hulls.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "domains/interval/elementary_tables.h"
#include "domains/interval/kernel.h"
#include "domains/interval/reverse.h"
#include "domains/rounding.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

using oracle::Dice;
using oracle::Real;
using oracle::truth;

std::string told(const Interval& a, const Interval& b) {
  char text[200];
  std::snprintf(text, sizeof text, "[%a, %a] and [%a, %a], seed %llu", a.lo(), a.hi(), b.lo(), b.hi(),
                static_cast<unsigned long long>(Dice::kSeed));
  return text;
}

void expect_tightest_waves(double x) {
  const Interval point(x);
  EXPECT_EQ(sin(point), truth(mpfr_sin, x)) << told(point, point);
  EXPECT_EQ(cos(point), truth(mpfr_cos, x)) << told(point, point);
}

// How far a table's value is from the function's, relative to it, in units of 2^-106.
double units_off(oracle::Unary function, double x, const DoubleDouble& value) {
  oracle::Real truth(x, 400), stored(value.hi, 400);
  function(truth.get(), truth.get(), MPFR_RNDN);
  mpfr_add_d(stored.get(), stored.get(), value.lo, MPFR_RNDN);
  mpfr_sub(stored.get(), stored.get(), truth.get(), MPFR_RNDN);
  if (mpfr_zero_p(stored.get()) != 0) return 0.0;
  mpfr_div(stored.get(), stored.get(), truth.get(), MPFR_RNDN);
  return std::abs(mpfr_get_d(stored.get(), MPFR_RNDA)) * 0x1p106;
}

TEST(Elementary, TablesAreRight) {
  for (std::size_t j = 0; j < kSines.size(); ++j) {
    const double x = static_cast<double>(j) * kSineSpacing;
    EXPECT_LE(units_off(mpfr_sin, x, kSines[j]), 1.0) << j;
    EXPECT_LE(units_off(mpfr_cos, x, kCosines[j]), 1.0) << j;
  }
  for (std::size_t j = 0; j < kArctangents.size(); ++j)
    EXPECT_LE(units_off(mpfr_atan, static_cast<double>(j) * kAtanSpacing, kArctangents[j]), 1.0) << j;
}

TEST(Elementary, PiIsTightest) {
  Real lo, hi;
  mpfr_const_pi(lo.get(), MPFR_RNDD);
  mpfr_const_pi(hi.get(), MPFR_RNDU);
  EXPECT_EQ(pi(), Interval(mpfr_get_d(lo.get(), MPFR_RNDN), mpfr_get_d(hi.get(), MPFR_RNDN)));
}

TEST(Elementary, WavesOfPointsAreTightest) {
  Dice dice;
  for (int i = 0; i < 25000 && !HasFailure(); ++i) expect_tightest_waves(dice.any());
  for (int i = 0; i < 25000 && !HasFailure(); ++i) expect_tightest_waves(dice.uniform(-10, 10));
  for (int i = 0; i < 20000 && !HasFailure(); ++i) expect_tightest_waves(dice.uniform(-0x1p20, 0x1p20));
}

TEST(Elementary, WavesAreTightestWhereReductionIsHard) {
  const double half_pi = 0x1.921fb54442d18p+0;
  for (int i = -3000; i <= 3000 && !::testing::Test::HasFailure(); ++i) {
    const double k = std::abs(i) <= 1500 ? i : i * 223.0;  // to 2^20 and beyond
    for (const double x : {k * half_pi, std::nextafter(k * half_pi, kInfinity), k * half_pi / 2, k / 128,
                           (k + 0.5) / 128, std::nextafter((k + 0.5) / 128, 0)}) {
      expect_tightest_waves(x);
    }
  }
  // The double nearest to a multiple of pi/2 (Muller, Elementary Functions, section 11.3.2), and the ends of
  // the range.
  for (const double x : {6381956970095103.0 * 0x1p797, 0x1p20, 0x1.fffffffffffffp19, 0x1.fffffffffffffp1023,
                         0x1p-26, 0x1.0000000000001p-26, 0x1p-1074, 0x1p-1022, -0.0}) {
    expect_tightest_waves(x);
    expect_tightest_waves(-x);
  }
}

/// The image of sin (or cos) over [lo, hi]: its ends, and the extrema at (k + 1/2) pi (or k pi) found by
/// counting.
Interval true_wave(const Interval& a, bool cosine) {
  if (!a.is_bounded()) return Interval(-1, 1);
  const oracle::Unary f = cosine ? mpfr_cos : mpfr_sin;
  Interval image = join(truth(f, a.lo()), truth(f, a.hi()));
  Real first(0, 2400), last(0, 2400), pi(0, 2400);
  mpfr_const_pi(pi.get(), MPFR_RNDN);
  mpfr_set_d(first.get(), a.lo(), MPFR_RNDN);
  mpfr_set_d(last.get(), a.hi(), MPFR_RNDN);
  for (Real* bound : {&first, &last}) {
    mpfr_div(bound->get(), bound->get(), pi.get(), MPFR_RNDN);
    if (!cosine) mpfr_sub_d(bound->get(), bound->get(), 0.5, MPFR_RNDN);
  }
  mpfr_ceil(first.get(), first.get());
  mpfr_floor(last.get(), last.get());
  for (int i = 0; i < 2 && mpfr_cmp(first.get(), last.get()) <= 0; ++i) {
    Real half(0, 2400);
    mpfr_div_2ui(half.get(), first.get(), 1, MPFR_RNDN);
    image = join(image, Interval(mpfr_integer_p(half.get()) ? 1.0 : -1.0));
    mpfr_add_ui(first.get(), first.get(), 1, MPFR_RNDN);
  }
  return image;
}

TEST(Elementary, WavesOfIntervalsAreTightest) {
  Dice dice;
  for (int i = 0; i < 20000; ++i) {
    Interval a = dice.interval();
    if (i % 2 == 0) {
      const double lo = dice.uniform(-20, 20);
      a = Interval(lo, lo + dice.uniform(0, 8));
    } else if (i % 5 == 0) {
      const double lo = std::ldexp(dice.uniform(-1, 1), dice.below(60));
      a = Interval(lo, lo + dice.uniform(0, 8));
    }
    ASSERT_EQ(sin(a), true_wave(a, false)) << told(a, a);
    ASSERT_EQ(cos(a), true_wave(a, true)) << told(a, a);
  }
}

TEST(Elementary, WavesOfKnownIntervals) {
  const double half_pi = 0x1.921fb54442d18p+0, above_half_pi = 0x1.921fb54442d19p+0;
  EXPECT_EQ(sin(Interval(half_pi, above_half_pi)).hi(), 1.0);
  EXPECT_EQ(sin(Interval(0, half_pi)), Interval(0, 1));
  EXPECT_EQ(sin(Interval(-0.0, 0.0)), Interval(0.0));
  EXPECT_EQ(cos(Interval(-1e-300, 0.0)), Interval(1 - 0x1p-53, 1));
  EXPECT_EQ(cos(Interval(0.0)), Interval(1.0));
  EXPECT_EQ(sin(Interval::entire()), Interval(-1, 1));
  EXPECT_EQ(sin(Interval(0, kInfinity)), Interval(-1, 1));
  EXPECT_EQ(cos(Interval(-0x1.fffffffffffffp1023, 0x1.fffffffffffffp1023)), Interval(-1, 1));
  EXPECT_TRUE(sin(Interval::empty()).is_empty() && cos(Interval::empty()).is_empty());
}

TEST(Elementary, AnglesOfPointsAreTightest) {
  Dice dice;
  for (int i = 0; i < 50000; ++i) {
    double y = dice.any(), x = dice.any();
    if (i % 4 == 0) y = std::round(128 * x) / 128;
    if (i % 4 == 1) x = dice.uniform(-10, 10), y = dice.uniform(-10, 10);
    if (i % 32 == 2) y = x * (1 + 0x1p-52);
    if (!std::isfinite(y) || (y == 0 && x == 0)) continue;
    ASSERT_EQ(atan2(Interval(y), Interval(x)), truth(mpfr_atan2, y + 0.0, x))
        << told(Interval(y), Interval(x));
  }
}

/// The hull of the angles at the corners of the box and where it meets the axes, or all angles when the cut
/// is crossed.
Interval true_angles(const Interval& y, const Interval& x) {
  if (y.lo() < 0 && y.hi() >= 0 && x.lo() < 0) return Interval(-pi().hi(), pi().hi());
  std::vector<double> ordinates = {y.lo() + 0.0, y.hi() + 0.0}, abscissae = {x.lo(), x.hi()};
  if (y.contains(0)) ordinates.push_back(0.0);
  if (x.contains(0)) abscissae.push_back(0.0);
  Interval hull = Interval::empty();
  for (const double v : ordinates) {
    for (const double u : abscissae) {
      if (v != 0 || u != 0) hull = join(hull, truth(mpfr_atan2, v, u));
    }
  }
  return hull;
}

TEST(Elementary, AnglesOfBoxesAreTightest) {
  Dice dice;
  for (int i = 0; i < 40000; ++i) {
    Interval y = dice.interval(), x = dice.interval();
    if (i % 3 == 0) y = Interval::raw(0.0, std::abs(y.mid()));
    if (i % 5 == 0) x = Interval::raw(-std::abs(x.mid()), 0.0);
    if (i % 7 == 0) y = -y;
    if (i % 11 == 0) x = -x;
    ASSERT_EQ(atan2(y, x), true_angles(y, x)) << told(y, x);
  }
}

TEST(Elementary, AnglesOfKnownBoxes) {
  const Interval zero(0.0), one(1.0), half_pi(pi().lo() / 2, pi().hi() / 2);
  EXPECT_TRUE(atan2(zero, zero).is_empty());
  EXPECT_TRUE(atan2(Interval::empty(), one).is_empty());
  EXPECT_EQ(atan2(zero, one), zero);
  EXPECT_EQ(atan2(zero, -one), pi());
  EXPECT_EQ(atan2(Interval::raw(-0.0, -0.0), -one), pi());
  EXPECT_EQ(atan2(one, zero), half_pi);
  EXPECT_EQ(atan2(-one, zero), -half_pi);
  EXPECT_EQ(atan2(Interval(-1, 0), -one), Interval(-pi().hi(), pi().hi())) << "crosses the cut";
  EXPECT_EQ(atan2(Interval(-1, 0), one).hi(), 0.0);
  EXPECT_EQ(atan2(Interval(0, 1), Interval(-1, 1)), Interval(0, pi().hi()));
  EXPECT_EQ(atan2(Interval(-1, 1), Interval(0, 1)), Interval(-half_pi.hi(), half_pi.hi()));
  EXPECT_EQ(atan2(Interval(1, kInfinity), Interval(1, kInfinity)), Interval(0, half_pi.hi()));
  EXPECT_EQ(atan2(Interval::entire(), Interval::entire()), Interval(-pi().hi(), pi().hi()));
}

/// A part of [-1.2, 1.2], often one value only.
Interval range_of_waves(Dice& dice) {
  const double a = dice.uniform(-1.2, 1.2), b = dice.below(3) == 0 ? a : dice.uniform(-1.2, 1.2);
  if (dice.below(10) == 0) return Interval(dice.below(3) - 1.0);
  return Interval(std::min(a, b), std::max(a, b));
}

Interval moderate(Dice& dice) {
  const double lo =
      dice.below(4) == 0 ? std::ldexp(dice.uniform(-1, 1), dice.below(34)) : dice.uniform(-20, 20);
  return Interval(lo, lo + (dice.below(3) == 0 ? dice.uniform(0, 0.01) : dice.uniform(0, 12)));
}

TEST(ElementaryReverse, WavesKeepEverySolution) {
  Dice dice;
  for (int i = 0; i < 60000; ++i) {
    const Interval x = i % 4 == 0 ? dice.interval() : moderate(dice);
    const double t = dice.in(x);
    const Interval sine = sin(Interval(t)), cosine = cos(Interval(t));
    // The exact sine lies between neighbouring doubles: an enclosure of it is the least set known to hold it.
    ASSERT_TRUE(sin_rev(sine, x).contains(t)) << told(Interval(t), x);
    ASSERT_TRUE(cos_rev(cosine, x).contains(t)) << told(Interval(t), x);
  }
}

TEST(ElementaryReverse, WavesAreTight) {
  Dice dice;
  const auto near_value = [](Interval image(const Interval&), double bound, const Interval& c) {
    const double slack = 8 * 0x1p-52 * std::max(std::abs(bound), 0x1p-60);
    return !meet(image(Interval(bound - slack, bound + slack)), c).is_empty();
  };
  for (int i = 0; i < 60000; ++i) {
    const Interval x = moderate(dice), c = range_of_waves(dice);
    if (x.mag() > 0x1p29) continue;
    for (const bool cosine : {false, true}) {
      const Interval part = cosine ? cos_rev(c, x) : sin_rev(c, x);
      const auto image = cosine ? static_cast<Interval (*)(const Interval&)>(cos)
                                : static_cast<Interval (*)(const Interval&)>(sin);
      ASSERT_TRUE(leq(part, x));
      if (part.is_empty()) continue;
      ASSERT_TRUE(near_value(image, part.lo(), c) && near_value(image, part.hi(), c)) << told(c, x);
    }
  }
}

TEST(ElementaryReverse, WavesAreIsotone) {
  Dice dice;
  for (int i = 0; i < 60000; ++i) {
    const Interval x = i % 4 == 0 ? dice.interval() : moderate(dice), c = range_of_waves(dice);
    const Interval inner = dice.within(x), value = dice.within(c);
    ASSERT_TRUE(leq(sin_rev(value, inner), sin_rev(c, x))) << told(c, x) << told(value, inner);
    ASSERT_TRUE(leq(cos_rev(value, inner), cos_rev(c, x))) << told(c, x) << told(value, inner);
  }
}

TEST(ElementaryReverse, WavesOnKnownSets) {
  EXPECT_TRUE(sin_rev({2, 3}, Interval::entire()).is_empty());
  EXPECT_TRUE(sin_rev({0, 1}, Interval::empty()).is_empty());
  EXPECT_TRUE(sin_rev(Interval::empty(), {0, 1}).is_empty());
  EXPECT_EQ(sin_rev({-1, 1}, {3, 4}), Interval(3, 4));
  EXPECT_EQ(sin_rev({0, 1}, Interval::entire()), Interval::entire());
  EXPECT_EQ(sin_rev(Interval(0.0), {-1, 1}), Interval(0.0));
  EXPECT_EQ(sin_rev(Interval(0.0), {3, 4}), pi());
  EXPECT_EQ(cos_rev(Interval(1.0), {-1, 1}), Interval(0.0));
  const Interval turn = cos_rev(Interval(-1.0), {3, 4});  // where two branches touch
  EXPECT_TRUE(leq(pi(), turn) && turn.width() <= 4 * pi().width());
  EXPECT_TRUE(sin_rev({0.5, 1}, {3, 6}).is_empty()) << "x lies in a gap";
  EXPECT_TRUE(cos_rev({0.5, 1}, {2, 4}).is_empty());
  const Interval part = sin_rev({0, 0.5}, {-2, 20});
  EXPECT_EQ(part.lo(), 0.0);
  EXPECT_NEAR(part.hi(), 6 * 3.14159265358979 + 0.523598775598299, 1e-12);
}

TEST(ElementaryReverse, AnglesKeepEverySolution) {
  Dice dice;
  for (int i = 0; i < 40000; ++i) {
    Interval y = dice.interval(), x = dice.interval();
    if (i % 2 == 0) {
      y = moderate(dice);
      x = moderate(dice);
    }
    const double y0 = dice.in(y), x0 = dice.in(x);
    const Interval angle = atan2(Interval(y0), Interval(x0));
    if (angle.is_empty()) continue;
    const std::string context = told(y, x) + " at " + told(Interval(y0), Interval(x0));
    ASSERT_TRUE(atan2_rev(angle, y, x)) << context;
    ASSERT_TRUE(y.contains(y0) && x.contains(x0)) << context;
  }
}

TEST(ElementaryReverse, AnglesAreIsotone) {
  Dice dice;
  for (int i = 0; i < 30000; ++i) {
    Interval y = dice.interval(), x = dice.interval();
    if (i % 2 == 0) y = moderate(dice), x = moderate(dice);
    const double a = dice.uniform(-3.3, 3.3), b = dice.uniform(-3.3, 3.3);
    const Interval angle(std::min(a, b), std::max(a, b)), less = dice.within(angle);
    const std::string context = told(y, x) + " at " + told(angle, less);
    Interval inner_y = dice.within(y), inner_x = dice.within(x);
    atan2_rev(angle, y, x);
    atan2_rev(less, inner_y, inner_x);
    ASSERT_TRUE(leq(inner_y, y) && leq(inner_x, x)) << context;
  }
}

void expect_part(const Interval& angle, Interval y, Interval x, const Interval& wanted_y,
                 const Interval& wanted_x) {
  EXPECT_EQ(atan2_rev(angle, y, x), !wanted_y.is_empty());
  for (const auto& [found, wanted] : {std::pair(y, wanted_y), std::pair(x, wanted_x)}) {
    EXPECT_TRUE(leq(wanted, found)) << to_string(found) << " for " << to_string(wanted);
    if (wanted.is_empty()) {
      EXPECT_TRUE(found.is_empty()) << to_string(found);
    } else if (wanted.is_bounded()) {
      EXPECT_LE(found.width() - wanted.width(), 1e-14) << to_string(found) << " for " << to_string(wanted);
    } else {
      EXPECT_EQ(found, wanted);
    }
  }
}

TEST(ElementaryReverse, AnglesOfKnownBoxes) {
  const Interval none = Interval::empty(), all = Interval::entire(), quarter = Interval(0.25) * pi();
  const double half = 0.5 * pi().hi(), whole = pi().hi();
  expect_part({0, quarter.hi()}, {-10, 10}, {1, 2}, {0, 2}, {1, 2});
  expect_part({quarter.lo(), half}, {1, 2}, {-10, 10}, {1, 2}, {0, 2});
  expect_part({half, whole}, all, all, {0, kInfinity}, {-kInfinity, 0});
  expect_part({-whole, -half}, all, all, {-kInfinity, 0}, {-kInfinity, 0});
  expect_part({-1, 1}, {-1, 1}, {-5, 5}, {-1, 1}, {0, 5});
  expect_part({2, 3}, {-5, -1}, {-5, 5}, none, none);
  expect_part({2, 3}, {1, 2}, {1, 2}, none, none);
  expect_part({5, 6}, all, all, none, none);
  expect_part({0, 1}, Interval(0.0), Interval(0.0), none, none);
  expect_part({-1, 1}, Interval(0.0), {-5, 5}, Interval(0.0), {0, 5});
  expect_part(quarter, {0, 3}, {2, 8}, {2, 3}, {2, 3});
  expect_part({-3 * quarter.hi(), -3 * quarter.lo()}, {-3, 0}, {-8, -2}, {-3, -2}, {-3, -2});
  expect_part(Interval(0.0), {-3, 3}, {2, 8}, Interval(0.0), {2, 8});
  expect_part({whole - 1e-15, whole}, {-3, 3}, {-8, 8}, {0, 7e-15}, {-8, 0});
}

}  // namespace
}  // namespace hcsp
