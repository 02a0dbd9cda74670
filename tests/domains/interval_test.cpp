// SPDX-License-Identifier: Apache-2.0
// Interval: lattice laws; forward operations bit for bit against MPFR; reverse operations on sampled
// solutions; text.
#include "domains/interval/interval.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "domains/interval/kernel.h"
#include "domains/rounding.h"
#include "tests/support/laws.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

using oracle::Dice;
using oracle::truth;

constexpr double kLargest = 0x1.fffffffffffffp1023;
constexpr double kSmallest = 0x1p-1074;

std::string told(const Interval& a, const Interval& b) {
  return to_string(a) + " and " + to_string(b) + ", seed " + std::to_string(Dice::kSeed);
}

TEST(Interval, ObeysTheLatticeLaws) {
  Dice dice;
  std::vector<Interval> samples = {Interval::entire(),
                                   Interval::empty(),
                                   {0, 1},
                                   {1, 2},
                                   {3, 4},
                                   {0, 4},
                                   {1, 3},
                                   1.0,
                                   Interval::raw(-0.0, 0.0),
                                   Interval(0, kInfinity),
                                   Interval(-kInfinity, -1)};
  for (int i = 0; i < 10; ++i) samples.push_back(dice.interval());
  check_lattice_laws(samples);
}

TEST(Interval, RefusesWhatIsNoInterval) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Interval{kInfinity}, std::invalid_argument);
  EXPECT_THROW(Interval{nan}, std::invalid_argument);
  EXPECT_THROW(Interval(1, 0), std::invalid_argument);
  EXPECT_THROW(Interval(nan, 1), std::invalid_argument);
  EXPECT_THROW(Interval(0, nan), std::invalid_argument);
  EXPECT_THROW(Interval(kInfinity, kInfinity), std::invalid_argument);
  EXPECT_THROW(Interval(-kInfinity, -kInfinity), std::invalid_argument);
}

TEST(Interval, MeasuresItself) {
  EXPECT_EQ(Interval(1, 3).width(), 2.0);
  EXPECT_EQ(Interval(-kSmallest, 1).width(), 1.0 + 0x1p-52) << "rounded up";
  EXPECT_EQ(Interval(-kLargest, kLargest).width(), kInfinity);
  EXPECT_EQ(Interval::empty().width(), 0.0);
  EXPECT_EQ(Interval(1, 3).mid(), 2.0);
  EXPECT_EQ(Interval(-kLargest, kLargest).mid(), 0.0);
  EXPECT_EQ(Interval(kLargest, kLargest).mid(), kLargest);
  EXPECT_EQ(Interval(kSmallest, kSmallest).mid(), kSmallest);
  EXPECT_TRUE(Interval(3, kInfinity).contains(Interval(3, kInfinity).mid()));
  EXPECT_TRUE(Interval(-kInfinity, -3).contains(Interval(-kInfinity, -3).mid()));
  EXPECT_EQ(Interval(-4, 3).mag(), 4.0);
  EXPECT_EQ(to_string(Interval::empty()), "[empty]");
}

/// The hull of f at the corners of a and b, leaving out what is no number but 0 * oo = 0.
Interval over_corners(oracle::Binary f, const Interval& a, const Interval& b, bool zero_times_infinity) {
  Interval hull = Interval::empty();
  for (const double x : {a.lo(), a.hi()}) {
    for (const double y : {b.lo(), b.hi()}) {
      const bool indefinite = zero_times_infinity && ((x == 0 && std::isinf(y)) || (y == 0 && std::isinf(x)));
      hull = join(hull, indefinite ? Interval(0.0) : truth(f, x, y));
    }
  }
  return hull;
}

TEST(Interval, SumsDifferencesAndProductsAreTightest) {
  Dice dice;
  for (int i = 0; i < 60000; ++i) {
    const Interval a = dice.interval(), b = dice.interval();
    const Interval sum =
        Interval::raw(truth(mpfr_add, a.lo(), b.lo()).lo(), truth(mpfr_add, a.hi(), b.hi()).hi());
    const Interval difference =
        Interval::raw(truth(mpfr_sub, a.lo(), b.hi()).lo(), truth(mpfr_sub, a.hi(), b.lo()).hi());
    ASSERT_EQ(a + b, sum) << told(a, b);
    ASSERT_EQ(a - b, difference) << told(a, b);
    ASSERT_EQ(a * b, over_corners(mpfr_mul, a, b, true)) << told(a, b);
  }
}

/// The quotient by cases on where zero lies in b.
Interval true_quotient(const Interval& a, const Interval& b) {
  const Interval zero(0.0);
  if (b == zero) return Interval::empty();
  if (a == zero) return zero;
  if (b.lo() < 0 && b.hi() > 0) return Interval::entire();
  if (b.hi() <= 0) return true_quotient(-a, -b);
  const auto bound = [&](double x, bool away, bool up) {  // x divided by b.lo (away from zero) or by b.hi
    if (x == 0) return 0.0;
    if (std::isinf(x)) return x;
    const double by = away ? b.lo() : b.hi();
    if (by == 0) return x > 0 ? kInfinity : -kInfinity;
    const Interval q = truth(mpfr_div, x, by);
    return up ? q.hi() : q.lo();
  };
  return Interval::raw(bound(a.lo(), a.lo() < 0, false), bound(a.hi(), a.hi() > 0, true));
}

TEST(Interval, QuotientsAreTightest) {
  Dice dice;
  for (int i = 0; i < 60000; ++i) {
    const Interval a = dice.interval();
    Interval b = dice.interval();
    if (dice.below(2) == 0) b = Interval::raw(std::abs(b.mid()) / 2, std::abs(b.mid()));
    if (dice.below(8) == 0) b = Interval::raw(0.0, std::max(b.hi(), 1.0));
    if (dice.below(2) == 0) b = -b;
    ASSERT_EQ(a / b, true_quotient(a, b)) << told(a, b);
  }
  EXPECT_EQ(Interval(1, 2) / Interval(0.0), Interval::empty());
  EXPECT_EQ(Interval(1, 2) / Interval(0, 1), Interval(1, kInfinity));
  EXPECT_EQ(Interval(0, 2) / Interval(0, 1), Interval(0, kInfinity));
}

TEST(Interval, SquaresAndRootsAreTightest) {
  Dice dice;
  for (int i = 0; i < 60000; ++i) {
    const Interval a = dice.interval();
    const double near = a.contains(0) ? 0.0 : std::min(std::abs(a.lo()), std::abs(a.hi()));
    const double far = std::max(std::abs(a.lo()), std::abs(a.hi()));
    ASSERT_EQ(sqr(a), Interval::raw(truth(mpfr_sqr, near).lo(), truth(mpfr_sqr, far).hi())) << told(a, a);
    ASSERT_EQ(abs(a), Interval::raw(near, far)) << told(a, a);
    const Interval root = a.hi() < 0 ? Interval::empty()
                                     : Interval::raw(a.lo() <= 0 ? 0.0 : truth(mpfr_sqrt, a.lo()).lo(),
                                                     truth(mpfr_sqrt, a.hi()).hi());
    ASSERT_EQ(sqrt(a), root) << told(a, a);
    const Interval b = dice.interval();
    ASSERT_EQ(min(a, b), Interval::raw(std::min(a.lo(), b.lo()), std::min(a.hi(), b.hi()))) << told(a, b);
    ASSERT_EQ(max(a, b), Interval::raw(std::max(a.lo(), b.lo()), std::max(a.hi(), b.hi()))) << told(a, b);
  }
}

TEST(Interval, TheEmptySetGivesTheEmptySet) {
  const Interval none = Interval::empty(), some(1, 2);
  for (const Interval& r : {none + some, some - none, none * some, some / none, none / some, sqr(none),
                            sqrt(none), abs(none), min(none, some), max(some, none), -none}) {
    EXPECT_TRUE(r.is_empty());
    EXPECT_EQ(r.lo(), kInfinity) << "in its one form";
  }
}

TEST(Interval, ScalingIsTheProductByAPoint) {
  Dice dice;
  const RoundUpward guard;
  for (int i = 0; i < 100000; ++i) {
    const Interval a = dice.interval();
    const double factor = dice.in(dice.interval());
    if (factor == 0.0 || !std::isfinite(factor)) continue;
    ASSERT_EQ(up::scale(factor, a), up::mul(Interval::raw(factor, factor), a)) << factor << " " << told(a, a);
  }
  EXPECT_TRUE(up::scale(-2.0, Interval::empty()).is_empty());
}

TEST(Interval, ReverseOperationsKeepEverySolution) {
  Dice dice;
  for (int i = 0; i < 100000; ++i) {
    const Interval x = dice.interval(), b = dice.interval();
    const double x0 = dice.in(x), b0 = dice.in(b);
    const Interval product = Interval(x0) * Interval(b0), square = sqr(Interval(x0)),
                   root = sqrt(Interval(x0));
    const Interval least = min(Interval(x0), Interval(b0)), most = max(Interval(x0), Interval(b0));
    RoundUpward guard;
    ASSERT_TRUE(up::mul_rev(b, product, x).contains(x0)) << x0 << " " << b0 << " " << told(x, b);
    ASSERT_TRUE(up::sqr_rev(square, x).contains(x0)) << x0 << " " << told(x, x);
    ASSERT_TRUE(up::abs_rev(Interval(std::abs(x0)), x).contains(x0)) << x0 << " " << told(x, x);
    ASSERT_TRUE(x0 < 0 || up::sqrt_rev(root, x).contains(x0)) << x0 << " " << told(x, x);
    ASSERT_TRUE(up::min_rev(b, least, x).contains(x0)) << x0 << " " << b0 << " " << told(x, b);
    ASSERT_TRUE(up::max_rev(b, most, x).contains(x0)) << x0 << " " << b0 << " " << told(x, b);
  }
}

TEST(Interval, ReverseOperationsReachKnownHulls) {
  RoundUpward guard;
  const Interval all = Interval::entire();
  EXPECT_EQ(up::mul_rev({2, 4}, {4, 8}, all), Interval(1, 4));
  EXPECT_EQ(up::mul_rev({-1, 1}, {2, 4}, {-1, 8}), Interval(2, 8))
      << "each side is met before they are joined";
  EXPECT_EQ(up::mul_rev({-1, 1}, {2, 4}, {-1, 1}), Interval::empty());
  EXPECT_EQ(up::mul_rev(Interval(0.0), {1, 2}, all), Interval::empty());
  EXPECT_EQ(up::mul_rev({-1, 1}, {-1, 1}, {3, 4}), Interval(3, 4));
  EXPECT_EQ(up::sqr_rev({4, 9}, all), Interval(-3, 3));
  EXPECT_EQ(up::sqr_rev({4, 9}, {-1, 8}), Interval(2, 3));
  EXPECT_EQ(up::sqr_rev({-9, -4}, all), Interval::empty());
  EXPECT_EQ(up::abs_rev({1, 2}, {-9, 0}), Interval(-2, -1));
  EXPECT_EQ(up::sqrt_rev({-1, 3}, all), Interval(0, 9));
  EXPECT_EQ(up::min_rev({5, 6}, {1, 2}, all), Interval(1, 2));
  EXPECT_EQ(up::min_rev({1, 6}, {1, 2}, all), Interval(1, kInfinity));
  EXPECT_EQ(up::min_rev({0, 0.5}, {1, 2}, all), Interval::empty());
  EXPECT_EQ(up::max_rev({0, 0.5}, {1, 2}, all), Interval(1, 2));
}

/// The truth about a literal: MPFR's value, rounded both ways.
Interval true_literal(const std::string& text) {
  oracle::Real lo, hi;
  mpfr_strtofr(lo.get(), text.c_str(), nullptr, 0, MPFR_RNDD);
  mpfr_strtofr(hi.get(), text.c_str(), nullptr, 0, MPFR_RNDU);
  return Interval::raw(mpfr_get_d(lo.get(), MPFR_RNDD), mpfr_get_d(hi.get(), MPFR_RNDU));
}

TEST(IntervalOfDecimal, KnownLiterals) {
  EXPECT_EQ(Interval::of_decimal("0.5"), Interval(0.5));
  EXPECT_EQ(Interval::of_decimal("0.1"), Interval(0x1.9999999999999p-4, 0x1.999999999999ap-4));
  EXPECT_EQ(Interval::of_decimal("-0.1"), Interval(-0x1.999999999999ap-4, -0x1.9999999999999p-4));
  EXPECT_EQ(Interval::of_decimal("+12.5e1"), Interval(125.0));
  EXPECT_EQ(Interval::of_decimal("1e22"), Interval(1e22));
  EXPECT_EQ(Interval::of_decimal("9007199254740993"), Interval(9007199254740992, 9007199254740994));
  EXPECT_EQ(Interval::of_decimal("1e999"), Interval(kLargest, kInfinity));
  EXPECT_EQ(Interval::of_decimal("-1e999"), Interval(-kInfinity, -kLargest));
  EXPECT_EQ(Interval::of_decimal("1e-999"), Interval(0, kSmallest));
  EXPECT_EQ(Interval::of_decimal("-1e-999"), Interval(-kSmallest, 0));
  EXPECT_EQ(Interval::of_decimal("1e99999999999999999999"), Interval(kLargest, kInfinity));
  EXPECT_EQ(Interval::of_decimal("1e-99999999999999999999"), Interval(0, kSmallest));
  EXPECT_EQ(Interval::of_decimal("0e99999999999999999999"), Interval(0.0));
  EXPECT_EQ(Interval::of_decimal("-0.000"), Interval(0.0));
  EXPECT_EQ(Interval::of_decimal(".5"), Interval(0.5));
  EXPECT_EQ(Interval::of_decimal("5."), Interval(5.0));
  EXPECT_EQ(Interval::of_decimal("0x1.8p-3"), Interval(0x1.8p-3));
  EXPECT_EQ(Interval::of_decimal("-0X.8"), Interval(-0.5));
  EXPECT_EQ(Interval::of_decimal("0x1.00000000000001"), Interval(1.0, 1.0 + 0x1p-52));
  EXPECT_EQ(Interval::of_decimal("5e-324"), Interval(kSmallest, 2 * kSmallest));
  EXPECT_EQ(Interval::of_decimal("1" + std::string(400, '0')), Interval(kLargest, kInfinity));
  EXPECT_EQ(Interval::of_decimal("0." + std::string(2000, '0') + "1"), Interval(0, kSmallest));
  EXPECT_EQ(Interval::of_decimal("0.5" + std::string(2000, '0') + "1"), Interval(0.5, 0.5 + 0x1p-53));
}

TEST(IntervalOfDecimal, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"",   "+",     "-",   ".",   "oo", "-oo", "inf", "nan",  "1x",  "1 ",  " 1",   "1e",       "1e+",
        "e5", "1.2.3", "--1", "+-1", "0x", "0x.", "0xg", "0x1p", "1p3", "1,5", "1e5.", "infinity", "1_000"}) {
    EXPECT_THROW(Interval::of_decimal(text), std::invalid_argument) << '"' << text << '"';
  }
  EXPECT_THROW(Interval::of_decimal(std::string_view("1\0", 2)), std::invalid_argument);
}

TEST(IntervalOfDecimal, IsTightest) {
  Dice dice;
  for (int i = 0; i < 60000; ++i) {
    std::string text = dice.below(2) == 0 ? "-" : "";
    const int digits = 1 + dice.below(i % 2 == 0 ? 8 : 24), point = dice.below(digits + 1);
    for (int d = 0; d < digits; ++d) {
      if (d == point) text += '.';
      text += static_cast<char>('0' + (dice.below(3) == 0 ? 0 : dice.below(10)));
    }
    if (dice.below(2) == 0) text += 'e' + std::to_string(dice.below(60) - 30);
    if (dice.below(20) == 0) text += text.find('e') == std::string::npos ? "e-310" : "";
    ASSERT_EQ(Interval::of_decimal(text), true_literal(text)) << text << ", seed " << Dice::kSeed;
  }
}

TEST(IntervalOfDecimal, ReadsBackWhatWasPrinted) {
  Dice dice;
  for (int i = 0; i < 20000; ++i) {
    const double x = dice.any();
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    ASSERT_TRUE(Interval::of_decimal(text).contains(x)) << text;
    ASSERT_EQ(Interval::of_decimal(text), true_literal(text)) << text;
    std::snprintf(text, sizeof text, "%a", x);
    ASSERT_EQ(Interval::of_decimal(text), Interval(x)) << text;
  }
}

}  // namespace
}  // namespace hcsp
