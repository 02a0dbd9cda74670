// SPDX-License-Identifier: Apache-2.0
#include "solver/search/tape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "domains/rounding.h"
#include "solver/expression/expr.h"

namespace hcsp {
namespace {

struct TapeTest : ::testing::Test {
  Dag dag;
  std::vector<Input> inputs{{Input::Kind::real, 0, 0, 0}, {Input::Kind::real, 1, 0, 0}};
  Expr x{dag, dag.input(inputs[0])}, y{dag, dag.input(inputs[1])};
};

// The gradient over a box holds every difference quotient in it (mean value theorem).
TEST_F(TapeTest, GradientsEncloseDifferenceQuotients) {
  const Expr roots[] = {
      x * y + sqr(x) - sin(x * y),           exp(x) / (y + Interval(3.0)) + pown(x, 5) * y,
      sqrt(sqr(x) + sqr(y) + Interval(0.5)), abs(x - y) + max(x, y),
      atan2(y, x + Interval(4.0)),           log(x + Interval(3.0)) - Interval(2.0) * (x - y) - y};
  std::vector<NodeId> nodes;
  for (const Expr& root : roots) nodes.push_back(root.node());
  const Tape tape(dag, nodes, inputs);
  TapeRun run(tape);
  const RoundUpward guard;
  const std::vector<Interval> box{Interval(-1, 1.5), Interval(-0.75, 2)};
  run.evaluate(box, true);
  std::vector<std::vector<Interval>> gradients(nodes.size(), std::vector<Interval>(2));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    run.gradient(i, gradients[i]);
    EXPECT_TRUE(run.is_continuous(i));
  }
  const auto at = [&](double a, double b, std::size_t i) {
    run.evaluate(std::vector{Interval(a), Interval(b)}, false);
    return run.value(i).mid();
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (double a = -1; a < 1.5; a += 0.25) {
      for (double b = -0.75; b < 2; b += 0.25) {
        constexpr double kStep = 0.125, kRounding = 1e-12;
        const double by_x = (at(a + kStep, b, i) - at(a, b, i)) / kStep;
        const double by_y = (at(a, b + kStep, i) - at(a, b, i)) / kStep;
        EXPECT_FALSE(meet(gradients[i][0], Interval(by_x - kRounding, by_x + kRounding)).is_empty()) << i;
        EXPECT_FALSE(meet(gradients[i][1], Interval(by_y - kRounding, by_y + kRounding)).is_empty()) << i;
      }
    }
  }
}

// f(p) - f(c) lies in the slopes times p - c, for points p all over random boxes.
TEST_F(TapeTest, SlopesFromTheCenterEncloseDifferences) {
  const Expr roots[] = {x * y + sqr(x) - sin(x * y),
                        exp(x) / (y + Interval(4.0)) + pown(x, 5) * y,
                        sqrt(sqr(x) + Interval(0.5)) / (x + Interval(5.0)),
                        abs(x - y) + max(x, y),
                        cos(x) + tan(x * Interval(0.25)),
                        log(x + Interval(4.0)) - cosh(y) + sinh(x) * tanh(y),
                        pown(x + Interval(4.0), -3) * y,
                        root(x, 3) + root(y + Interval(4.0), 4),
                        asin(x * Interval(0.25)) - acos(y * Interval(0.25)) + atan(x),
                        x / x + pow(y + Interval(4.0), x)};
  std::vector<NodeId> nodes;
  for (const Expr& root : roots) nodes.push_back(root.node());
  const Tape tape(dag, nodes, inputs);
  TapeRun run(tape), at(tape);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> position(-3.0, 3.0), part(0.0, 1.0);
  const RoundUpward guard;
  for (int round = 0; round < 200; ++round) {
    std::vector<Interval> box, center;
    for (int v = 0; v < 2; ++v) {
      const double a = position(random), b = position(random);
      box.emplace_back(std::min(a, b), std::max(a, b));
      const double c = round % 3 == 0 ? box.back().lo() : box.back().mid();
      center.emplace_back(c);
    }
    run.evaluate_from(center, box);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      std::vector<Interval> slopes(2, Interval(0.0));
      if (!run.is_continuous(i)) continue;
      run.slopes(i, slopes);
      for (int k = 0; k < 10; ++k) {
        const double p = box[0].lo() + part(random) * box[0].width(),
                     q = box[1].lo() + part(random) * box[1].width();
        const std::vector<Interval> point{meet(Interval(p), box[0]), meet(Interval(q), box[1])};
        if (point[0].is_empty() || point[1].is_empty()) continue;
        at.evaluate(point, false);
        const Interval difference = at.value(i) - run.value_at_center(i);
        const Interval told = slopes[0] * (point[0] - center[0]) + slopes[1] * (point[1] - center[1]);
        EXPECT_FALSE(meet(difference, told).is_empty()) << i << " seed 1, round " << round;
      }
    }
  }
}

// A square's slope from the middle of a box is as wide as the box, its gradient twice as wide.
TEST_F(TapeTest, SlopesOfSquaresAreHalfAsWideAsGradients) {
  const Tape tape(dag, {(sqr(x) + pown(y, 4)).node()}, inputs);
  TapeRun run(tape);
  const RoundUpward guard;
  const std::vector<Interval> box{Interval(1, 3), Interval(1, 3)};
  std::vector<Interval> slopes(2), gradient(2);
  run.evaluate_from(std::vector{Interval(2.0), Interval(2.0)}, box);
  run.slopes(0, slopes);
  run.gradient(0, gradient);
  EXPECT_EQ(slopes[0], Interval(3, 5));
  EXPECT_EQ(gradient[0], Interval(2, 6));
  EXPECT_EQ(slopes[1], Interval(15, 65));
  EXPECT_EQ(gradient[1], Interval(4, 108));
}

TEST_F(TapeTest, KnowsWhereExpressionsJumpOrEnd) {
  const Expr roots[] = {log(x), sqrt(y), y / x, atan2(x, y), tan(x), pow(y, x), asin(y)};
  std::vector<NodeId> nodes;
  for (const Expr& root : roots) nodes.push_back(root.node());
  const Tape tape(dag, nodes, inputs);
  TapeRun run(tape);
  const RoundUpward guard;
  const auto continuous = [&](const Interval& a, const Interval& b) {
    run.evaluate(std::vector{a, b}, true);
    std::string text;
    for (std::size_t i = 0; i < nodes.size(); ++i) text += run.is_continuous(i) ? '1' : '0';
    return text;
  };
  EXPECT_EQ(continuous({1.25, 1.5}, {0.5, 1}), "1111111");
  EXPECT_EQ(continuous({-0.5, 0.5}, {-2, 2}), "0000100");
  EXPECT_EQ(continuous({1.25, 1.75}, {-2, -1}), "1011000");
}

// What one relation says of a common sub-expression holds in the other.
TEST_F(TapeTest, RelationsShareWhatTheyKnow) {
  const Expr sum = x + y;
  const Tape tape(dag, {(sum - Interval(3.0)).node(), (exp(sum) * y).node()}, inputs);
  TapeRun run(tape);
  const RoundUpward guard;
  run.start(std::vector{Interval(-10, 10), Interval(-10, 10)});
  ASSERT_TRUE(run.revise(0, Interval(0.0)));
  ASSERT_TRUE(run.revise(1, Interval(0, 1)));
  EXPECT_NEAR(run.variable(1).hi(), std::exp(-3.0), 1e-12);
  EXPECT_FALSE(run.revise(0, Interval(20.0, 30.0)));
}

TEST_F(TapeTest, HoldsNoChoices) {
  EXPECT_TRUE(fits_tape(dag, (x + y).node()));
  EXPECT_FALSE(fits_tape(dag, if_then_else(x > y, x, y).node()));
  EXPECT_FALSE(fits_tape(dag, (x > y).node()));
  EXPECT_FALSE(fits_tape(dag, (x + floor(y)).node()));
}

}  // namespace
}  // namespace hcsp
