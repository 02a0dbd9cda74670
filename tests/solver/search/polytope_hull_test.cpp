// SPDX-License-Identifier: Apache-2.0
#include "solver/search/polytope_hull.h"

#include <gtest/gtest.h>

#include <random>

#include "domains/rounding.h"
#include "solver/expression/expr.h"
#include "solver/search/curve.h"

namespace hcsp {
namespace {

// ---- Linear programs, against their vertices.

struct Row {
  int a, b, most;  // a x + b y <= most
};

// The least x over the vertices of rows in integers: an enclosure of it, or nothing without a feasible
// vertex.
Interval least_x(const std::vector<Row>& rows) {
  Interval least = Interval::empty();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      std::int64_t det = rows[i].a * rows[j].b - rows[j].a * rows[i].b;
      if (det == 0) continue;
      std::int64_t x = rows[i].most * rows[j].b - rows[j].most * rows[i].b;
      std::int64_t y = rows[i].a * rows[j].most - rows[j].a * rows[i].most;
      if (det < 0) det = -det, x = -x, y = -y;
      const bool is_feasible = std::all_of(
          rows.begin(), rows.end(), [&](const Row& row) { return row.a * x + row.b * y <= row.most * det; });
      if (!is_feasible) continue;
      const Interval at = Interval(static_cast<double>(x)) / Interval(static_cast<double>(det));
      least = least.is_empty() ? at : min(least, at);
    }
  }
  return least;
}

TEST(LinearProgram, BoundsAreNeverAboveTheLeastVertexAndNextToIt) {
  std::mt19937_64 random(20);
  std::uniform_int_distribution<int> factor(-9, 9), most(-20, 40);
  int feasible = 0, refuted = 0;
  for (int k = 0; k < 3000; ++k) {
    std::vector<Row> rows{{1, 0, 10}, {-1, 0, 10}, {0, 1, 10}, {0, -1, 10}};
    LinearProgram program;
    const RoundUpward guard;
    program.start(std::vector<Interval>{Interval(-10.0, 10.0), Interval(-10.0, 10.0)});
    for (int i = 0; i < 4; ++i) {
      const Row row{factor(random), factor(random), most(random)};
      rows.push_back(row);
      const std::vector<LinearTerm> terms{{0, static_cast<double>(row.a)}, {1, static_cast<double>(row.b)}};
      program.add_row(terms, Interval::raw(-kInfinity, row.most));
    }
    const Interval truth = least_x(rows);
    const bool alive = program.contract(0, true);
    if (truth.is_empty()) {
      refuted += alive ? 0 : 1;
      continue;
    }
    ASSERT_TRUE(alive) << "case " << k;
    ++feasible;
    ASSERT_LE(program.columns()[0].lo(), truth.hi()) << "case " << k;
    ASSERT_GE(program.columns()[0].lo(), truth.lo() - 1e-7) << "case " << k;
  }
  EXPECT_GE(feasible, 1000);
  EXPECT_GE(refuted, 500);
}

// ---- Curves.

TEST(Curve, SlopesAndBendsAreThoseOfTheValues) {
  const RoundUpward guard;
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> number(0.05, 0.9);
  const auto check = [&](const Curve& curve, double shift) {
    const double a = number(random) + shift, b = a + 1e-4, c = a + 2e-4;
    const Interval whole(a, c);
    const auto at = [&](double x) { return curve.value(Interval(x)); };
    const Interval chord = (at(c) - at(a)) / (Interval(c) - Interval(a));
    EXPECT_FALSE(meet(chord, curve.slope(whole)).is_empty()) << static_cast<int>(curve.op);
    const Interval bend = curve.bend(whole), second = at(c) - Interval(2.0) * at(b) + at(a);
    EXPECT_TRUE(second.lo() <= 1e-13 || bend.hi() > 0.0) << static_cast<int>(curve.op);
    EXPECT_TRUE(second.hi() >= -1e-13 || bend.lo() < 0.0) << static_cast<int>(curve.op);
  };
  for (int k = 0; k < 200; ++k) {
    for (const Op op : {Op::sqr, Op::abs, Op::sin, Op::cos, Op::exp, Op::tan, Op::asin, Op::acos, Op::atan,
                        Op::sinh, Op::cosh, Op::tanh})
      check({op, Interval(0.0)}, k % 2 == 0 ? 0.0 : -0.95);
    for (const Op op : {Op::sqrt, Op::log}) check({op, Interval(0.0)}, 0.0);
    for (const double n : {-3.0, -2.0, -1.0, 2.0, 3.0, 4.0}) {
      check({Op::pown, Interval(n)}, 0.0);
      check({Op::pown, Interval(n)}, -1.0);
    }
    for (const double b : {-1.5, 0.5, 2.5}) check({Op::pow, Interval(b)}, 0.0);
    for (const double n : {2.0, 3.0}) check({Op::root, Interval(n)}, 0.0);
    for (const double n : {-2.0, 3.0}) check({Op::div, Interval(n)}, k % 2 == 0 ? 0.0 : -1.0);
  }
}

// ---- The hull of systems.

struct PolytopeHullTest : ::testing::Test {
  static constexpr VariableId kUnknowns = 3;
  Dag dag;
  std::vector<System::Unknown> unknowns;
  std::vector<Expr> x;
  std::mt19937_64 random{22};
  PolytopeHullTest() {
    for (VariableId v = 0; v < kUnknowns; ++v) {
      unknowns.push_back({{Input::Kind::real, v, 0, 0}, Interval::entire()});
      x.emplace_back(dag, dag.input(unknowns.back().input));
    }
  }
  System system(const std::vector<Expr>& relations) {
    std::vector<NodeId> nodes;
    for (const Expr& relation : relations) nodes.push_back(relation.node());
    return {dag, nodes, unknowns};
  }
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }
  int choice(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); }

  Expr term(int depth) {
    if (depth == 0) return x[static_cast<std::size_t>(choice(kUnknowns))];
    const Expr a = term(depth - 1), b = term(choice(depth));
    switch (choice(20)) {
      case 0:
        return a + b;
      case 1:
        return a - b;
      case 2:
        return a * b;
      case 3:
        return a / b;
      case 4:
        return sqr(a);
      case 5:
        return sqrt(a);
      case 6:
        return exp(Interval(0.1) * a);
      case 7:
        return log(a);
      case 8:
        return sin(a);
      case 9:
        return cos(a);
      case 10:
        return pown(a, 3);
      case 11:
        return abs(a);
      case 12:
        return max(a, b);
      case 13:
        return min(a, b);
      case 14:
        return atan(a);
      case 15:
        return tan(a);
      case 16:
        return Interval(number(-3.0, 3.0)) * a;
      case 17:
        return pown(a, -1);
      case 18:
        return root(a, 3);
      default:
        return atan2(a, b);
    }
  }
};

// Thousands of systems around a known solution: it stays, also with the sides far out or unbounded.
TEST_F(PolytopeHullTest, KeepsKnownSolutions) {
  int kept = 0;
  for (int k = 0; k < 3000; ++k) {
    std::vector<double> known;
    std::vector<Interval> point, box;
    for (VariableId v = 0; v < kUnknowns; ++v) {
      known.push_back(number(-4.0, 4.0));
      point.emplace_back(known.back());
      const double far = choice(4) == 0 ? 1e3 : 2.0;
      box.emplace_back(known.back() - number(0.0, far), known.back() + number(0.0, far));
      if (choice(30) == 0) box.back() = Interval::raw(box.back().lo(), kInfinity);
    }
    std::vector<Expr> relations;
    for (int i = 0; i < 3; ++i) {
      const Expr left = term(3);
      const Program program(dag, {left.node()});
      Evaluation evaluation(program);
      const RoundUpward guard;
      for (std::uint32_t input = 0; input < program.inputs().size(); ++input)
        evaluation.set(input, point[program.inputs()[input].variable]);
      evaluation.forward();
      const Interval value = evaluation.get(program.root());
      if (!evaluation.defined(program.root()) || !value.is_bounded()) continue;
      relations.push_back(left <= Interval(value.hi()));
      if (choice(2) == 0) relations.push_back(left >= Interval(value.lo()));
    }
    const System made = system(relations);
    const RoundUpward guard;
    PolytopeHull hull(made);
    ASSERT_TRUE(hull.contract(box)) << "case " << k;
    for (std::size_t v = 0; v < kUnknowns; ++v) ASSERT_TRUE(box[v].contains(known[v])) << "case " << k;
    ++kept;
  }
  EXPECT_EQ(kept, 3000);
}

TEST_F(PolytopeHullTest, IsTheHullOfWhatIsLinear) {
  const System linear = system({x[0] + x[1] + x[2] <= Interval(1.0), x[0] - x[1] >= Interval(0.5),
                                x[0] + Interval(2.0) * x[1] >= Interval(0.25), x[2] >= Interval(0.0)});
  std::vector<Interval> box(3, Interval(-100.0, 100.0));
  const RoundUpward guard;
  PolytopeHull hull(linear);
  ASSERT_TRUE(hull.contract(box));
  const std::vector<Interval> truth{Interval(5.0 / 12, 1.75), Interval(-0.75, 0.25), Interval(0.0, 2.0 / 3)};
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_LE(box[v].lo(), truth[v].lo() + 1e-12);
    EXPECT_GE(box[v].hi(), truth[v].hi() - 1e-12);
    EXPECT_NEAR(box[v].lo(), truth[v].lo(), 1e-6);
    EXPECT_NEAR(box[v].hi(), truth[v].hi(), 1e-6);
  }
}

// x y >= 1, x + y <= 1.9 in [0, 2]^2: no point, which neither HC4 nor a corner shows.
TEST_F(PolytopeHullTest, RefutesByMcCormickPlanes) {
  const System apart = system({x[0] * x[1] >= Interval(1.0), x[0] + x[1] <= Interval(1.5)});
  std::vector<Interval> box(3, Interval(0.0, 2.0));
  const RoundUpward guard;
  PolytopeHull hull(apart);
  EXPECT_FALSE(hull.contract(box));
}

}  // namespace
}  // namespace hcsp
