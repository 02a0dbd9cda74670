// SPDX-License-Identifier: Apache-2.0
// The functions on known values and in their corners; their soundness and tightness at large are the
// campaign's (tests/soundness/interval_campaign_test.cpp).
#include "domains/interval/functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "domains/interval/exp_log_tables.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

const Interval kEmpty = Interval::empty();
const Interval kEntire = Interval::entire();

// How far hi + lo is from a number, relative to it, in units of 2^-106.
double units_off(const DoubleDouble& value, oracle::Real& truth) {
  oracle::Real stored(value.hi, 400);
  mpfr_add_d(stored.get(), stored.get(), value.lo, MPFR_RNDN);
  mpfr_sub(stored.get(), stored.get(), truth.get(), MPFR_RNDN);
  if (mpfr_zero_p(stored.get()) != 0) return 0.0;
  mpfr_div(stored.get(), stored.get(), truth.get(), MPFR_RNDN);
  return std::abs(mpfr_get_d(stored.get(), MPFR_RNDA)) * 0x1p106;
}

TEST(Functions, TablesAreRight) {
  for (std::size_t j = 0; j < kPowersOfTwo.size(); ++j) {
    oracle::Real truth(static_cast<double>(j) / 512, 400);
    mpfr_exp2(truth.get(), truth.get(), MPFR_RNDN);
    EXPECT_LE(units_off(kPowersOfTwo[j], truth), 1.0) << j;
  }
  for (std::size_t j = 0; j < kReciprocals.size(); ++j) {
    const Reciprocal& entry = kReciprocals[j];
    EXPECT_NEAR(entry.r * (kFirstReciprocal + static_cast<double>(j)), 512.0, 1e-3) << j;
    EXPECT_EQ(std::ldexp(entry.r, 20), std::floor(std::ldexp(entry.r, 20))) << j;
    oracle::Real truth(entry.r, 400);
    mpfr_log(truth.get(), truth.get(), MPFR_RNDN);
    mpfr_neg(truth.get(), truth.get(), MPFR_RNDN);
    EXPECT_LE(units_off(entry.log, truth), 1.0) << j;
  }
}

TEST(Functions, ExpAndLogOfPointsAreTightest) {
  const auto of_exp = [](double x) { return exp(Interval::raw(x, x)); };
  const auto of_log = [](double x) { return log(Interval::raw(x, x)); };
  for (int i = -2000; i <= 2000; ++i) {
    const double x = i * 0.35 + 1e-3 * i * i / 7, positive = std::exp2(i * 0.51);
    EXPECT_EQ(of_exp(x), oracle::truth(mpfr_exp, x)) << x;
    EXPECT_EQ(of_log(positive), oracle::truth(mpfr_log, positive)) << positive;
    const double near_one = 1.0 + i * 0x1p-40;
    EXPECT_EQ(of_log(near_one), oracle::truth(mpfr_log, near_one)) << near_one;
  }
}

TEST(Functions, DomainsOfDefinition) {
  EXPECT_TRUE(log({-2, 0}).is_empty());
  EXPECT_EQ(log({-2, 1}), Interval::raw(-kInfinity, 0.0));
  EXPECT_EQ(log(kEntire), kEntire);
  EXPECT_EQ(exp(Interval::raw(-kInfinity, 0.0)), Interval(0, 1));
  EXPECT_TRUE(exp(kEmpty).is_empty());
  EXPECT_TRUE(acosh({-3, 0.5}).is_empty());
  EXPECT_EQ(atanh({-1, 1}), kEntire);
  EXPECT_TRUE(atanh({1, 2}).is_empty());
  EXPECT_TRUE(asin({2, 3}).is_empty());
  EXPECT_EQ(recip({0, 2}), Interval::raw(0.5, kInfinity));
  EXPECT_TRUE(recip(Interval(0.0)).is_empty());
}

TEST(Functions, Powers) {
  EXPECT_EQ(pown({-2, 3}, 3), Interval(-8, 27));
  EXPECT_EQ(pown({-2, 3}, 4), Interval(0, 81));
  EXPECT_EQ(pown({-2, 3}, 0), Interval(1.0));
  EXPECT_EQ(pown({-2, 4}, -1), kEntire);
  EXPECT_EQ(pown({0, 4}, -1), Interval::raw(0.25, kInfinity));
  EXPECT_EQ(pown({-2, 4}, -2), Interval::raw(0.0625, kInfinity));
  EXPECT_EQ(rootn({-27, 8}, 3), Interval(-3, 2));
  EXPECT_EQ(rootn({-27, 16}, 4), Interval(0, 2));
  EXPECT_EQ(rootn({0, 16}, -4), Interval::raw(0.5, kInfinity));
  EXPECT_THROW(rootn({1, 2}, 0), std::invalid_argument);
  EXPECT_EQ(pow({4, 9}, {0.5, 0.5}), Interval(2, 3));
  EXPECT_EQ(pow({0, 0.5}, {0, 2}), Interval(0, 1));
  EXPECT_EQ(pow(Interval(0.0), {-1, 1}), Interval(0.0));
  EXPECT_TRUE(pow(Interval(0.0), {-1, 0}).is_empty());
}

TEST(Functions, TangentHasPoles) {
  EXPECT_EQ(tan({1, 2}), kEntire);
  EXPECT_EQ(tan({-100, 100}), kEntire);
  EXPECT_FALSE(tan({1.58, 4.71}).is_entire());
  EXPECT_TRUE(tan(Interval(1e300)).is_bounded());
}

TEST(Functions, Steps) {
  EXPECT_EQ(round_ties_to_even({-2.5, 3.5}), Interval(-2, 4));
  EXPECT_EQ(round_ties_to_even({0.5, 1.5}), Interval(0, 2));
  EXPECT_EQ(round_ties_to_away({-2.5, 3.5}), Interval(-3, 4));
  EXPECT_EQ(floor({-1.5, 1.5}), Interval(-2, 1));
  EXPECT_EQ(ceil({-1.5, 1.5}), Interval(-1, 2));
  EXPECT_EQ(trunc({-1.5, 1.5}), Interval(-1, 1));
  EXPECT_EQ(sign({-1.5, 0}), Interval(-1, 0));
}

TEST(Functions, Cancellation) {
  EXPECT_EQ(cancel_minus({0, 5}, {1, 3}), Interval(-1, 2));
  EXPECT_EQ(cancel_minus({0, 1}, {1, 3}), kEntire);
  EXPECT_EQ(cancel_plus({0, 5}, {-3, -1}), Interval(-1, 2));
  EXPECT_TRUE(cancel_minus(kEmpty, {1, 3}).is_empty());
  EXPECT_EQ(cancel_minus({1, 3}, kEmpty), kEntire);
}

}  // namespace
}  // namespace hcsp
