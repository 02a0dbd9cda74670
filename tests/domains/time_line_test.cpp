// SPDX-License-Identifier: Apache-2.0
#include "domains/time_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cstdlib>
#include <string>

#include "tests/support/oracle.h"

namespace hcsp {
namespace {

// The double nearest k / 10, as a reader of the decimal would see it.
double tenths(int k) { return std::strtod((std::to_string(k) + "e-1").c_str(), nullptr); }

TEST(TimeLine, GridInstantsAreTheNearestDoublesOfTheDecimals) {
  const TimeLine line = TimeLine::grid(0, 100, 0.1);
  ASSERT_EQ(line.slices(), 1000U);
  for (int k = 0; k <= 1000; ++k) ASSERT_EQ(line.instants()[static_cast<std::size_t>(k)], tenths(k)) << k;
}

TEST(TimeLine, GridIsTheSameInEveryRoundingMode) {
  const TimeLine line = TimeLine::grid(0, 33.3, 0.3, {0.25, 7.7});
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const TimeLine again = TimeLine::grid(0, 33.3, 0.3, {0.25, 7.7});
    std::fesetround(FE_TONEAREST);
    EXPECT_TRUE(line == again);
  }
}

TEST(TimeLine, GridEndsWhereItIsTold) {
  EXPECT_EQ(TimeLine::grid(0, 1, 0.3).instants(), (std::vector{0.0, 0.3, 0.6, 0.9, 1.0}));
  EXPECT_EQ(TimeLine::grid(0, 1, 5).instants(), (std::vector{0.0, 1.0}));
  EXPECT_EQ(TimeLine::grid(-1, 1, 0.5).instants(), (std::vector{-1.0, -0.5, 0.0, 0.5, 1.0}));
}

TEST(TimeLine, JoinsJitteredStamps) {
  oracle::for_seeds(50, [](oracle::Dice& dice) {
    std::vector<double> stamps;
    for (int k = 0; k < 40; ++k) stamps.push_back(0.25 * k + dice.uniform(-0.05, 0.05));
    const TimeLine line = TimeLine::grid(0, 9, 0.1, stamps);
    EXPECT_EQ(line.start(), 0.0);
    EXPECT_EQ(line.end(), 9.0);
    EXPECT_TRUE(std::is_sorted(line.instants().begin(), line.instants().end(), std::less_equal<>()));
    for (const double t : stamps) EXPECT_EQ(line.gate_at(t).has_value(), 0 <= t && t <= 9) << t;
    for (std::size_t k = 0; k < line.slices(); ++k)
      EXPECT_LE(line.instants()[k + 1] - line.instants()[k], 0.1 + 1e-9);
  });
}

TEST(TimeLine, AStampThatIsNearlyAGridInstantReplacesIt) {
  const TimeLine line = TimeLine::grid(0, 1, 0.1, {3 * 0.1, 0.7 - 1e-12});
  EXPECT_EQ(line.slices(), 10U);
  EXPECT_TRUE(line.gate_at(3 * 0.1).has_value());
  EXPECT_FALSE(line.gate_at(0.3).has_value());
  EXPECT_TRUE(line.gate_at(0.7 - 1e-12).has_value());
}

TEST(TimeLine, StampsMayCountFromAnEpoch) {
  const double epoch = 1.7e9;
  std::vector<double> stamps;
  for (int k = 0; k <= 50; ++k) stamps.push_back(epoch + 0.1 * k);
  const TimeLine line = TimeLine::grid(stamps.front(), stamps.back(), 0.1, stamps);
  EXPECT_EQ(line.instants(), stamps);
  EXPECT_EQ(line.gate_at(stamps[17]), 17U);
}

TEST(TimeLine, ItemsAreGatesAndSlicesInTheOrderOfTime) {
  const TimeLine line({1.0, 2.0, 4.0});
  EXPECT_EQ(line.items(), 5U);
  EXPECT_EQ(line.span(0), Interval(1));
  EXPECT_EQ(line.span(1), Interval(1, 2));
  EXPECT_EQ(line.span(3), Interval(2, 4));
  EXPECT_EQ(line.span(4), Interval(4));
  EXPECT_EQ(line.gate_at(2.0), 1U);
  EXPECT_FALSE(line.gate_at(3.0).has_value());
  EXPECT_FALSE(line.gate_at(5.0).has_value());
  EXPECT_FALSE(line.gate_at(std::nan("")).has_value());
}

TEST(TimeLine, MisuseThrows) {
  const double nan = std::nan("");
  EXPECT_THROW(TimeLine({1.0}), std::invalid_argument);
  EXPECT_THROW(TimeLine({1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(TimeLine({1.0, nan}), std::invalid_argument);
  EXPECT_THROW(TimeLine({0.0, kInfinity}), std::invalid_argument);
  EXPECT_THROW(TimeLine::grid(1, 1, 0.1), std::invalid_argument);
  EXPECT_THROW(TimeLine::grid(0, 1, 0), std::invalid_argument);
  EXPECT_THROW(TimeLine::grid(0, 1, -1), std::invalid_argument);
  EXPECT_THROW(TimeLine::grid(0, 1, nan), std::invalid_argument);
  EXPECT_THROW(TimeLine::grid(0, 1e9, 1e-3), std::invalid_argument);
}

TEST(ItemSet, IsASet) {
  oracle::for_seeds(50, [](oracle::Dice& dice) {
    ItemSet a, b;
    std::vector<bool> plain(200, false);
    for (int i = 0; i < 40; ++i) {
      const auto item = static_cast<std::size_t>(dice.below(200));
      (i % 2 == 0 ? a : b).insert(item);
      plain[item] = true;
    }
    EXPECT_FALSE(a.is_none());
    a.join(b);
    std::vector<bool> visited(200, false);
    a.for_each([&](std::size_t item) { visited[item] = true; });
    EXPECT_EQ(visited, plain);
    for (std::size_t item = 0; item < 300; ++item) EXPECT_EQ(a.contains(item), item < 200 && plain[item]);
  });
  EXPECT_TRUE(ItemSet().is_none());
  for (const std::size_t items : {1U, 63U, 64U, 65U, 200U}) {
    EXPECT_TRUE(ItemSet::all(items).contains(items - 1));
    EXPECT_FALSE(ItemSet::all(items).contains(items));
  }
}

}  // namespace
}  // namespace hcsp
