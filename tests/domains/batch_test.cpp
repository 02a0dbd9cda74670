// SPDX-License-Identifier: Apache-2.0
// The batch forms give the bits of the operation on one interval: any size, in place, in any rounding mode.
#include "domains/interval/batch.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <functional>
#include <vector>

#include "domains/interval/functions.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

struct Arrays {
  std::vector<double> lo, hi;
  explicit Arrays(std::size_t n) : lo(n), hi(n) {}
  void set(std::size_t i, const Interval& a) {
    lo[i] = a.lo();
    hi[i] = a.hi();
  }
  [[nodiscard]] Interval at(std::size_t i) const { return Interval::raw(lo[i], hi[i]); }
  [[nodiscard]] batch::Intervals in() const { return {lo.data(), hi.data()}; }
  batch::Results out() { return {lo.data(), hi.data()}; }
};

using One = std::function<Interval(const Interval&, const Interval&)>;
using Many = std::function<void(std::size_t, batch::Intervals, batch::Intervals, batch::Results)>;

Arrays drawn(oracle::Dice& dice, std::size_t n) {
  Arrays a(n);
  for (std::size_t i = 0; i < n; ++i) a.set(i, dice.below(8) == 0 ? Interval::empty() : dice.interval());
  return a;
}

void expect_the_bits_of(const One& one, const Many& many) {
  oracle::Dice dice;
  for (std::size_t n = 0; n < 150; ++n) {
    const int mode = std::array{FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}[n % 4];
    Arrays a = drawn(dice, n);
    const Arrays b = drawn(dice, n), operands = a;
    Arrays result(n);
    std::fesetround(mode);
    many(n, a.in(), b.in(), result.out());
    many(n, a.in(), b.in(), a.out());
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    for (std::size_t i = 0; i < n; ++i) {
      const Interval expected = one(operands.at(i), b.at(i));
      ASSERT_EQ(result.at(i), expected) << ::testing::PrintToString(operands.at(i)) << " and "
                                        << ::testing::PrintToString(b.at(i)) << ", " << i << " of " << n;
      ASSERT_EQ(a.at(i), expected) << "in place, " << i << " of " << n;
      ASSERT_EQ(result.at(i).is_empty(), result.at(i).lo() == kInfinity && result.at(i).hi() == -kInfinity);
    }
  }
}

void expect_the_bits_of(Interval (*one)(const Interval&),
                        void (*many)(std::size_t, batch::Intervals, batch::Results)) {
  expect_the_bits_of(
      [one](const Interval& a, const Interval&) { return one(a); },
      [many](std::size_t n, batch::Intervals a, batch::Intervals, batch::Results r) { many(n, a, r); });
}

/// As `many` on arrays of bounds, by a form on arrays of intervals.
template <class Form>
void through_intervals(std::size_t n, batch::Intervals a, batch::Intervals b, batch::Results result,
                       const Form& form) {
  std::vector<Interval> left, right;
  for (std::size_t i = 0; i < n; ++i) {
    left.push_back(Interval::raw(a.lo[i], a.hi[i]));
    right.push_back(Interval::raw(b.lo[i], b.hi[i]));
  }
  form(n, left.data(), right.data(), left.data());
  for (std::size_t i = 0; i < n; ++i) {
    result.lo[i] = left[i].lo();
    result.hi[i] = left[i].hi();
  }
}

using Binary = Interval (*)(const Interval&, const Interval&);
using Unary = Interval (*)(const Interval&);

/// Both forms: of arrays of bounds, of arrays of intervals.
void expect_the_bits_of(Binary one,
                        void (*many)(std::size_t, batch::Intervals, batch::Intervals, batch::Results),
                        void (*row)(std::size_t, const Interval*, const Interval*, Interval*)) {
  expect_the_bits_of(One(one), Many(many));
  expect_the_bits_of(One(one), [row](std::size_t n, batch::Intervals a, batch::Intervals b,
                                     batch::Results result) { through_intervals(n, a, b, result, row); });
}

void expect_the_bits_of(Unary one, void (*many)(std::size_t, batch::Intervals, batch::Results),
                        void (*row)(std::size_t, const Interval*, Interval*)) {
  expect_the_bits_of(one, many);
  expect_the_bits_of([one](const Interval& a, const Interval&) { return one(a); },
                     [row](std::size_t n, batch::Intervals a, batch::Intervals b, batch::Results result) {
                       const auto form = [row](std::size_t size, const Interval* x, const Interval*,
                                               Interval* y) { row(size, x, y); };
                       through_intervals(n, a, b, result, form);
                     });
}

TEST(Batch, Arithmetic) {
  expect_the_bits_of([](const Interval& a) { return -a; }, batch::neg, batch::neg);
  expect_the_bits_of([](const Interval& a, const Interval& b) { return a + b; }, batch::add, batch::add);
  expect_the_bits_of([](const Interval& a, const Interval& b) { return a - b; }, batch::sub, batch::sub);
  expect_the_bits_of([](const Interval& a, const Interval& b) { return a * b; }, batch::mul, batch::mul);
  expect_the_bits_of([](const Interval& a, const Interval& b) { return a / b; }, batch::div, batch::div);
  expect_the_bits_of(sqr, batch::sqr, batch::sqr);
  expect_the_bits_of(sqrt, batch::sqrt, batch::sqrt);
}

TEST(Batch, Bounds) {
  expect_the_bits_of(abs, batch::abs, batch::abs);
  expect_the_bits_of(min, batch::min, batch::min);
  expect_the_bits_of(max, batch::max, batch::max);
  expect_the_bits_of(meet, batch::meet, batch::meet);
  expect_the_bits_of(join, batch::join, batch::join);
}

TEST(Batch, Powers) {
  for (const int n : {-2, 0, 2, 3, 5, 12})
    expect_the_bits_of([n](const Interval& a, const Interval&) { return pown(a, n); },
                       [n](std::size_t size, batch::Intervals a, batch::Intervals, batch::Results r) {
                         batch::pown(size, a, n, r);
                       });
}

TEST(Batch, ElementaryFunctions) {
  expect_the_bits_of(exp, batch::exp);
  expect_the_bits_of(log, batch::log);
  expect_the_bits_of(sin, batch::sin);
  expect_the_bits_of(cos, batch::cos);
  expect_the_bits_of(One(static_cast<Binary>(atan2)), batch::atan2);
}

}  // namespace
}  // namespace hcsp
