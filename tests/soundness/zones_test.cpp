// SPDX-License-Identifier: Apache-2.0
// "For every" needs definedness, cells are half-open, zones are open where the relation is strict.
#include <gtest/gtest.h>

#include "tests/soundness/slam_case.h"

namespace hcsp::soundness {

namespace {

// The set { a | relation(a) }, within the closed box [-5, 20] x [-5, 5].
SetInterval zone(const std::function<Expr(const VectorExpr& a)>& relation) {
  Problem problem("zone");
  const auto s = problem.set("S", 2, 0.25);
  const VectorExpr a = problem.point(2);
  const Expr in_box = abs(a[0] - Interval(7.5)) <= Interval(12.5) && abs(a[1]) <= Interval(5.0);
  problem.constrain_union("zone", s, {2, in_box && relation(a)});
  const Result result = problem.propagate();
  EXPECT_EQ(result.status, Status::contracted);
  return set(result, "S");
}

CellState at(const SetInterval& set, double a1, double a2) {
  const double point[2] = {a1, a2};
  return set.at(point);
}

}  // namespace

// sqrt is undefined left of zero: there sqrt(a1) < 3 is not certain, it is false. The value of the root
// alone, [0, 2] over [-1, 4], would tell otherwise.
TEST(Zones, ARelationIsFalseWhereATermIsUndefined) {
  const SetInterval s = zone([](const VectorExpr& a) { return sqrt(a[0]) < Interval(3.0); });
  int inside = 0;
  for (double a1 = -4.9; a1 < 20; a1 += 0.1) {
    for (double a2 = -4.9; a2 < 5; a2 += 1.1) {
      const CellState state = at(s, a1, a2);
      EXPECT_TRUE(a1 >= 0 || state != CellState::inside) << a1;
      EXPECT_TRUE(a1 >= -0.25 || state == CellState::outside) << a1;
      EXPECT_TRUE(a1 < 9 || state != CellState::inside) << a1;
      EXPECT_TRUE(a1 < 0 || a1 >= 9 || state != CellState::outside) << a1;
      inside += state == CellState::inside ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 500);
}

TEST(Zones, UndefinedTermsInsideConnectives) {
  const auto root_below_3 = [](const VectorExpr& a) { return sqrt(a[0]) < Interval(3.0); };
  const SetInterval complement = zone([&](const VectorExpr& a) { return !root_below_3(a); });
  EXPECT_EQ(at(complement, -2, 0), CellState::inside);  // false where undefined, so its negation is true
  EXPECT_EQ(at(complement, 4, 0), CellState::outside);
  EXPECT_EQ(at(complement, 12, 0), CellState::inside);
  const SetInterval either =
      zone([&](const VectorExpr& a) { return root_below_3(a) || a[1] > Interval(0.0); });
  EXPECT_EQ(at(either, -2, 2), CellState::inside);
  EXPECT_EQ(at(either, -2, -2), CellState::outside);
  EXPECT_EQ(at(either, 4, -2), CellState::inside);
  const SetInterval quotient =
      zone([](const VectorExpr& a) { return Interval(1.0) / a[0] > Interval(-1.0); });
  EXPECT_NE(at(quotient, 0.01, 0), CellState::inside);  // the cell holds a1 == 0, where nothing is certain
  EXPECT_EQ(at(quotient, 2, 0), CellState::inside);
  EXPECT_EQ(at(quotient, -0.5, 0), CellState::outside);
  EXPECT_EQ(at(quotient, -3, 0), CellState::inside);
}

// The undefined branch of a choice matters only where it is taken.
TEST(Zones, AChoiceIsDefinedWhereTheBranchTakenIs) {
  const SetInterval s = zone([](const VectorExpr& a) {
    return if_then_else(a[0] >= Interval(0.0), sqrt(a[0]), a[0] * Interval(0.0)) < Interval(3.0);
  });
  EXPECT_EQ(at(s, -2, 0), CellState::inside);
  EXPECT_EQ(at(s, 4, 0), CellState::inside);
  EXPECT_EQ(at(s, 12, 0), CellState::outside);
}

// Cells [i h, (i + 1) h) are decided on their closures: the open half-plane a1 < 1 certainly has the cells
// that end before 1, and the one that ends at 1 is left unknown; the closed one has it.
TEST(Zones, OpenAndClosed) {
  const SetInterval open = zone([](const VectorExpr& a) { return a[0] < Interval(1.0); });
  EXPECT_EQ(at(open, 0.74, 0), CellState::inside);
  EXPECT_EQ(at(open, 0.75, 0), CellState::unknown);
  EXPECT_EQ(at(open, 1.0, 0), CellState::outside);
  const SetInterval closed = zone([](const VectorExpr& a) { return a[0] <= Interval(1.0); });
  EXPECT_EQ(at(closed, 0.75, 0), CellState::inside);
  EXPECT_EQ(at(closed, 1.0, 0), CellState::unknown);
  EXPECT_EQ(at(closed, 1.25, 0), CellState::outside);
}

// The dug space is open at z: a wall exactly at distance z is not dug, so that it can be what was measured.
// With sizes that are exact in binary the zone's edge falls on the edge of cells.
TEST(Zones, TheDugSpaceIsOpenAtTheRange) {
  for (const bool fast : {true, false}) {
    Problem slam("open");
    slam.use_fast_paths(fast);
    slam.set_time_line(TimeLine({0, 1}));
    const auto line = slam.time_line();
    const auto z = slam.tube("z", sampled(line, {0, 1}, {Box{2.0}, Box{2.0}}));
    slam.set_readings(z, {{0, ""}, {1, ""}});
    const auto x = slam.tube("x", 2);
    const auto dug = slam.set("D", 2, 0.25);
    const auto map = slam.set("M", 2, 0.25, Box{{2, 2.25}, {-0.25, 0.25}});
    const auto a = slam.point(2);
    slam.constrain("start", slam.at(x, 0) == VectorExpr{slam.constant(0), slam.constant(0)});
    slam.constrain_derivative("no motion", x, {slam.constant(0), slam.constant(0)});
    slam.constrain_union("dug", dug, {2, norm(a - slam(x)) < slam(z)[0]});
    slam.constrain_disjoint("free", dug, map);
    slam.constrain_meets("impact", {2, norm(a - slam(x)) == slam(z)[0]}, map);
    const Result result = slam.propagate();
    ASSERT_EQ(result.status, Status::contracted) << "fast " << fast;
    EXPECT_EQ(at(set(result, "M"), 2.0, 0.0), CellState::unknown);
    EXPECT_EQ(at(set(result, "D"), 1.9, 0.0), CellState::unknown);  // its closure reaches the circle
    EXPECT_EQ(at(set(result, "D"), 1.7, 0.0), CellState::inside);
    EXPECT_EQ(at(set(result, "D"), 1.7, -0.1), CellState::inside);
  }
}

// A stated frame keeps every cell that its closed faces touch.
TEST(Zones, AFrameKeepsTheCellsOfItsFaces) {
  const SetInterval framed(2, 0.25, Box{{-1, 1}, {-1, 1}});
  EXPECT_EQ(at(framed, 1.0, 1.0), CellState::unknown);
  EXPECT_EQ(at(framed, 1.24, 0.0), CellState::unknown);
  EXPECT_EQ(at(framed, 1.25, 0.0), CellState::outside);
  EXPECT_EQ(at(framed, -1.0, -1.0), CellState::unknown);
  EXPECT_EQ(at(framed, -1.01, 0.0), CellState::outside);
}

}  // namespace hcsp::soundness
