// SPDX-License-Identifier: Apache-2.0
#include "domains/tube.h"

#include <gtest/gtest.h>

#include "tests/support/laws.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

std::shared_ptr<const TimeLine> line_of(std::vector<double> instants) {
  return std::make_shared<const TimeLine>(std::move(instants));
}

Tube random_tube(oracle::Dice& dice, const std::shared_ptr<const TimeLine>& line, std::size_t dim) {
  Tube tube(line, dim);
  for (std::size_t c = 0; c < dim; ++c) {
    for (std::size_t item = 0; item < tube.items(); ++item) {
      const double middle = dice.below(5);  // few values, so that tubes touch and nest
      tube.set(c, item, Interval(middle - dice.below(4), middle + dice.below(4)));
    }
  }
  return tube;
}

TEST(Tube, ObeysTheLatticeLaws) {
  oracle::Dice dice;
  const auto line = line_of({0.0, 1.0, 3.0});
  for (const std::size_t dim : {1U, 2U}) {
    std::vector<Tube> samples{Tube(line, dim), bottom(Tube(line, dim))};
    for (int i = 0; i < 6; ++i) samples.push_back(random_tube(dice, line, dim));
    Tube point(line, dim);
    for (std::size_t item = 0; item < point.items(); ++item) point.set(0, item, Interval(1));
    samples.push_back(point);
    check_lattice_laws(samples);
  }
}

TEST(Tube, OneEmptyItemEmptiesTheTube) {
  const auto line = line_of({0.0, 1.0});
  Tube tube(line, 2);
  EXPECT_TRUE(tube.meet_at(1, 1, Interval(0, 1)));
  EXPECT_FALSE(tube.meet_at(1, 1, Interval(-1, 2))) << "that changed nothing";
  EXPECT_FALSE(tube.is_empty());
  EXPECT_TRUE(tube.meet_at(1, 1, Interval(2, 3)));
  EXPECT_TRUE(tube.is_empty());
  EXPECT_TRUE(tube == bottom(tube));
}

TEST(Tube, ContractTellsWhichItemsChanged) {
  const auto line = line_of({0.0, 1.0, 2.0});
  Tube tube(line, 2), bound(line, 2);
  bound.set(0, 1, Interval(0, 1));
  bound.set(1, 4, Interval(0, 1));
  const ItemSet delta = contract(tube, bound);
  for (std::size_t item = 0; item < 5; ++item) EXPECT_EQ(delta.contains(item), item == 1 || item == 4);
}

TEST(Tube, GatesAndSlicesAreIndependentWithoutDer) {
  const auto line = line_of({0.0, 1.0, 2.0});
  Tube tube(line, 1);
  tube.set(0, 1, Interval(0, 1));
  tube.set(0, 2, Interval(5));  // a function may jump
  tube.set(0, 3, Interval(0, 1));
  EXPECT_FALSE(tube.is_empty());
  EXPECT_EQ(tube.gate(0, 1), Interval(5));
  EXPECT_EQ(tube.slice(0, 1), Interval(0, 1));
}

TEST(Tube, ShapesMustAgree) {
  const auto line = line_of({0.0, 1.0}), other = line_of({0.0, 2.0});
  Tube tube(line, 1);
  EXPECT_THROW(static_cast<void>(meet(tube, Tube(line, 2))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(join(tube, Tube(other, 1))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(leq(tube, Tube(other, 1))), std::invalid_argument);
  EXPECT_THROW(contract(tube, Tube(line, 3)), std::invalid_argument);
  EXPECT_THROW(Tube(line, 0), std::invalid_argument);
  EXPECT_NO_THROW(contract(tube, Tube(line_of({0.0, 1.0}), 1))) << "lines are compared by their instants";
}

TEST(Tube, MeasureIsTheMeanWidthOfTheWidestComponent) {
  const auto line = line_of({0.0, 1.0, 2.0});
  Tube tube(line, 2);
  EXPECT_EQ(measure(tube), kInfinity);
  for (std::size_t item = 0; item < 5; ++item) {
    tube.set(0, item, Interval(0, 1));
    tube.set(1, item, Interval(0, item == 3 ? 5 : 0.5));
  }
  EXPECT_EQ(measure(tube), 3.0);
  EXPECT_EQ(measure(bottom(tube)), 0.0);
}

TEST(Hold, KeepsAValueUntilTheNextStamp) {
  const auto line = line_of({0.0, 1.0, 2.0, 3.0, 4.0});
  const Tube tube = hold(line, {1.0, 2.5, 3.0}, {Box{{0, 1}}, Box{{5, 6}}, Box{{8, 9}}});
  EXPECT_TRUE(tube.gate(0, 0).is_entire()) << "nothing is known before the first stamp";
  EXPECT_TRUE(tube.slice(0, 0).is_entire());
  EXPECT_EQ(tube.gate(0, 1), Interval(0, 1));
  EXPECT_EQ(tube.slice(0, 1), Interval(0, 1));
  EXPECT_EQ(tube.gate(0, 2), Interval(0, 1));
  EXPECT_EQ(tube.slice(0, 2), Interval(0, 6)) << "a slice that a stamp divides takes the hull";
  EXPECT_EQ(tube.gate(0, 3), Interval(8, 9));
  EXPECT_EQ(tube.slice(0, 3), Interval(8, 9)) << "the last holds until the end";
  EXPECT_EQ(tube.gate(0, 4), Interval(8, 9));
}

TEST(Hold, EnclosesTheStaircaseAtEveryInstant) {
  oracle::for_seeds(100, [](oracle::Dice& dice) {
    std::vector<double> stamps, instants{0.0};
    for (double t = oracle::dyadic(dice, -2, 2); t < 12; t += oracle::dyadic(dice, 0.125, 2))
      stamps.push_back(t);
    while (instants.back() < 12) instants.push_back(instants.back() + oracle::dyadic(dice, 0.25, 1.5));
    std::vector<Box> values;
    for (std::size_t r = 0; r < stamps.size(); ++r) {
      const double x = oracle::dyadic(dice, -5, 5);
      values.push_back(Box{{x, x + 1}, {-x, 2 - x}});
    }
    const auto line = line_of(instants);
    const Tube tube = hold(line, stamps, values);
    for (double t = 0; t <= instants.back(); t += 0.0625) {
      const auto next = std::upper_bound(stamps.begin(), stamps.end(), t);
      if (next == stamps.begin()) continue;
      const Box& value = values[static_cast<std::size_t>(next - stamps.begin()) - 1];
      for (std::size_t item = 0; item < tube.items(); ++item) {
        const Interval span = line->span(item);
        const bool within = item % 2 == 0 ? span.lo() == t : span.lo() < t && t < span.hi();
        if (!within) continue;
        for (std::size_t c = 0; c < 2; ++c)
          EXPECT_TRUE(leq(value[static_cast<Eigen::Index>(c)], tube.at(c, item))) << t;
      }
    }
  });
}

TEST(Sampled, IsKnownAtItsStampsOnly) {
  const auto line = line_of({0.0, 1.0, 2.0});
  const Tube tube = sampled(line, {0.0, 2.0}, {Box{{1, 2}, {3, 4}}, Box{{5, 6}, {7, 8}}});
  EXPECT_EQ(tube.gate(0, 0), Interval(1, 2));
  EXPECT_EQ(tube.gate(1, 2), Interval(7, 8));
  for (std::size_t item = 1; item < 4; ++item)
    EXPECT_TRUE(tube.at(0, item).is_entire() && tube.at(1, item).is_entire());
}

TEST(Sampled, StampsMustBeInstants) {
  const auto line = line_of({0.0, 1.0});
  EXPECT_THROW(static_cast<void>(sampled(line, {0.5}, {Box{{1, 2}}})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sampled(line, {}, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sampled(line, {0.0, 1.0}, {Box{{1, 2}}})), std::invalid_argument);
}

TEST(Hold, RowsMustFit) {
  const auto line = line_of({0.0, 1.0});
  EXPECT_THROW(static_cast<void>(hold(line, {}, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(hold(line, {0.0}, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(hold(line, {1.0, 0.0}, {Box{{1, 2}}, Box{{1, 2}}})), std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
