// SPDX-License-Identifier: Apache-2.0
#include "domains/box.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/laws.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

TEST(Box, ObeysTheLatticeLaws) {
  oracle::Dice dice;
  std::vector<Box> samples = {Box(2),
                              bottom(Box(2)),
                              Box{{0, 1}, {0, 1}},
                              Box{{1, 2}, {1, 2}},
                              Box{{0, 1}, {3, 4}},
                              Box{{0, 2}, {0, 2}},
                              Box{Interval(0), Interval(0)}};
  for (int i = 0; i < 6; ++i) samples.push_back(Box{dice.interval(), dice.interval()});
  check_lattice_laws(samples);
}

TEST(Box, OfNoDimensionIsALatticeOfOneDomain) {
  EXPECT_FALSE(Box(0).is_empty());
  EXPECT_TRUE(Box(0) == top(Box(0)));
}

TEST(Box, OneEmptyComponentEmptiesTheBox) {
  const Box met = meet(Box{{0, 1}, {0, 1}}, Box{{0, 1}, {2, 3}});
  EXPECT_TRUE(met.is_empty());
  EXPECT_TRUE(met[0].is_empty()) << "there is one empty box, whichever component was first";
  const Box half_empty{Interval(0, 1), Interval::empty()};
  EXPECT_TRUE(half_empty == bottom(half_empty));
  EXPECT_TRUE(join(half_empty, Box{{5, 6}, {5, 6}}) == (Box{{5, 6}, {5, 6}}));
}

TEST(Box, ContractTellsWhetherSomethingChanged) {
  Box box{{0, 4}, {0, 4}};
  EXPECT_TRUE(contract(box, Box{{-1, 5}, {0, 4}}).is_none());
  EXPECT_FALSE(contract(box, Box{{1, 5}, {0, 4}}).is_none());
  EXPECT_TRUE(box == (Box{{1, 4}, {0, 4}}));
}

TEST(Box, ShapesMustAgree) {
  Box box(2);
  EXPECT_THROW(static_cast<void>(meet(box, Box(3))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(join(box, Box(3))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(leq(box, Box(3))), std::invalid_argument);
  EXPECT_THROW(contract(box, Box(3)), std::invalid_argument);
}

TEST(Box, MeasureIsTheWidestComponent) {
  EXPECT_EQ(measure(Box{{0, 1}, {2, 5}}), 3.0);
  EXPECT_EQ(measure(Box(2)), kInfinity);
  EXPECT_EQ(measure(bottom(Box(2))), 0.0);
}

TEST(Box, PrintsItsComponents) {
  const std::string text = to_string(Box{{0, 1}, {2, 5}});
  EXPECT_EQ(text, "([0, 1], [2, 5])");
}

TEST(IntervalMatrix, ProductsEncloseTheProductsOfPoints) {
  oracle::Dice dice;
  for (int trial = 0; trial < 200; ++trial) {
    IntervalMatrix a(2, 2);
    IntervalVector x(2);
    Eigen::Matrix2d inner;
    Eigen::Vector2d point;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        inner(i, j) = dice.below(2000) - 1000;  // so that the product of points is exact
        a(i, j) = Interval(inner(i, j) - dice.uniform(0, 1), inner(i, j) + dice.uniform(0, 1));
      }
      point(i) = dice.below(2000) - 1000;
      x(i) = Interval(point(i) - dice.uniform(0, 1), point(i));
    }
    const IntervalVector product = a * x;
    const Eigen::Vector2d exact = inner * point;
    EXPECT_TRUE(product(0).contains(exact(0)) && product(1).contains(exact(1)))
        << "seed " << oracle::Dice::kSeed;
  }
}

}  // namespace
}  // namespace hcsp
