// SPDX-License-Identifier: Apache-2.0
#include "solver/problem.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <functional>
#include <stdexcept>
#include <thread>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "tests/support/oracle.h"

namespace hcsp {
namespace {

// The misuse throws std::invalid_argument with a message that holds `word`.
void expect_misuse(const std::function<void()>& misuse, const std::string& word) {
  try {
    misuse();
    ADD_FAILURE() << "nothing was thrown where " << word << " was expected";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

class Misuse : public ::testing::Test {
 protected:
  Misuse() { p.set_time_line(TimeLine({0.0, 1.0, 2.0})); }
  Problem p{"misused"}, other{"other"};
};

TEST_F(Misuse, OfNames) {
  p.real("x");
  expect_misuse([&] { p.real("x"); }, "x");
  expect_misuse([&] { p.set("x", 2, 0.1); }, "x");
  expect_misuse([&] { p.tube("x", 1); }, "x");
}

TEST_F(Misuse, OfVectors) {
  expect_misuse([&] { p.vector("v", Box(0)); }, "v");
}

TEST_F(Misuse, OfTime) {
  expect_misuse([&] { p.set_time_line(TimeLine({0.0, 1.0})); }, "time line");
  expect_misuse([&] { other.tube("x", 1); }, "set_time_line");
  expect_misuse([&] { other.time(); }, "set_time_line");
  const auto elsewhere = std::make_shared<const TimeLine>(std::vector{0.0, 5.0});
  expect_misuse([&] { p.tube("y", Tube(elsewhere, 1)); }, "y");
  expect_misuse([&] { p.tube("z", 0); }, "dimension 0");
  const auto x = p.tube("x", 1);
  expect_misuse([&] { p.at(x, 0.5); }, "0.5");
  expect_misuse([&] { p.at(x, std::nan("")); }, "nan");
  expect_misuse([&] { p.set_readings(x, {{7, ""}}); }, "7");
}

TEST_F(Misuse, OfSets) {
  expect_misuse([&] { p.set("a", 0, 0.1); }, "0");
  expect_misuse([&] { p.set("b", 4, 0.1); }, "4");
  expect_misuse([&] { p.set("c", 2, 0.0); }, "precision");
  expect_misuse([&] { p.set("d", 2, -1.0); }, "precision");
  expect_misuse([&] { p.set("e", 2, kInfinity); }, "precision");
  expect_misuse([&] { p.set("f", 2, 0.1, Box{{0, 1}, Interval(1)}); }, "frame");
  expect_misuse([&] { p.set("g", 2, 0.1, Box{{0, 1}}); }, "frame");
  expect_misuse([&] { p.set("h", 2, 0.1, Box{{0, 1}, {0, 1e12}}); }, "frame");
  const auto fine = p.set("fine", 2, 0.1), coarse = p.set("coarse", 2, 0.2);
  expect_misuse([&] { p.constrain_disjoint("disjoint", fine, coarse); }, "precisions");
}

TEST_F(Misuse, OfConstraints) {
  const auto x = p.real("x");
  const auto t = p.tube("t", 2);
  const auto s = p.set("s", 2, 0.1);
  const auto y = other.real("y");
  expect_misuse([&] { p.constrain("not one", p(x) + 1.0); }, "relation");
  expect_misuse([&] { p.constrain("stranger", other(y) < 1.0); }, "another problem");
  expect_misuse([&] { static_cast<void>(p(x) + other(y)); }, "another problem");
  expect_misuse([&] { p.constrain_derivative("der", t, {p(x)}); }, "dimension 2");
  expect_misuse([&] { p.constrain_union("union", s, {3, p.point(3)[0] < 1.0}); }, "R^3");
  expect_misuse([&] { p.constrain_meets("meets", {1, p.point(1)[0] < 1.0}, s); }, "R^1");
  expect_misuse([&] { p.constrain_union("union", s, {2, p.point(2)[0] + 1.0}); }, "relation");
  expect_misuse([&] { p.constrain_range("range", p(x), p.point(3), norm(p.point(3)), s); }, "R^3");
}

TEST_F(Misuse, OfExpressionsOfAnotherProblem) {
  other.set_time_line(TimeLine({0.0, 1.0, 2.0}));
  const auto t = p.tube("t", 1);
  const auto u = other.tube("u", 1);
  expect_misuse([&] { p.constrain_derivative("der", t, other(u)); }, "another problem");
}

TEST_F(Misuse, OfBoundPoints) {
  const auto x = p.real("x");
  const auto t = p.tube("t", 1);
  const auto s = p.set("s", 2, 0.1);
  expect_misuse([&] { p.constrain("free point", p.point(2)[0] < p(x)); }, "point");
  expect_misuse([&] { p.constrain_derivative("free point", t, {p.point(1)[0]}); }, "point");
  expect_misuse([&] { p.constrain_union("third axis", s, {2, p.point(3)[2] < p(x)}); }, "point");
}

TEST_F(Misuse, OfResults) {
  p.real("x", {0, 1});
  const Result result = p.propagate();
  EXPECT_NO_THROW(static_cast<void>(result["x"]));
  EXPECT_THROW(static_cast<void>(result["y"]), std::out_of_range);
}

TEST(Problem, AnEmptyDomainIsInfeasible) {
  Problem p("empty");
  p.real("x", Interval::empty());
  EXPECT_EQ(p.propagate().status, Status::infeasible);
}

TEST(Problem, WithoutConstraintsIsAtItsFixedPoint) {
  Problem p("idle");
  p.real("x", {0, 1});
  const Result result = p.propagate();
  EXPECT_EQ(result.status, Status::contracted);
  EXPECT_EQ(std::get<Interval>(result["x"]), Interval(0, 1));
}

// A small problem with a piece of everything: a robot that drives along a line and feels a wall.
void post_robot(Problem& p) {
  p.set_time_line(TimeLine::grid(0, 2, 0.1));
  Tube speed(p.time_line(), 2);
  for (std::size_t item = 0; item < speed.items(); ++item) {
    speed.set(0, item, Interval::of_decimal("0.7") + Interval(-0.01, 0.01));
    speed.set(1, item, Interval(-0.05, 0.05));
  }
  const auto v = p.tube("v", speed), x = p.tube("x", 2);
  std::vector<double> stamps;
  std::vector<Box> ranges;
  std::vector<Reading> readings;
  for (std::size_t gate = 0; gate <= p.time_line()->slices(); gate += 4) {
    stamps.push_back(p.time_line()->instants()[gate]);
    const double range = 2.6 - 0.7 * stamps.back();
    ranges.push_back(Box{{range - 0.02, range + 0.02}});
    readings.push_back({gate, "reading " + std::to_string(gate)});
  }
  const auto z = p.tube("z", sampled(p.time_line(), stamps, ranges));
  p.set_readings(z, readings);
  const auto map = p.set("M", 2, 0.1, Box{{2.5, 2.9}, {-4, 4}});
  const auto dug = p.set("D", 2, 0.1);
  const VectorExpr a = p.point(2);
  const Expr distance = norm(a - p(x));
  p.constrain_derivative("evolution", x, {p(v)[0] * cos(p(v)[1]), p(v)[0] * sin(p(v)[1])});
  p.constrain("start", p.at(x, 0.0) == VectorExpr{p.constant({-0.2, 0.2}), p.constant({-0.1, 0.1})});
  p.constrain_union("dug", dug, {2, distance < p(z)[0]});
  p.constrain_disjoint("free", dug, map);
  p.constrain_meets("impact", {2, distance == p(z)[0]}, map);
}

const oracle::Build kRobot = post_robot;

TEST(Problem, PropagatedTwiceGivesTheSame) {
  Problem p("twice");
  post_robot(p);
  const Result first = p.propagate(), second = p.propagate();
  ASSERT_EQ(first.status, Status::contracted);
  EXPECT_LT(std::get<Tube>(first["x"]).gate(0, 20).width(), 0.4) << "something was learnt";
  oracle::expect_same(first, second, "the second time");
  EXPECT_EQ(first.statistics.passes, second.statistics.passes);
  oracle::expect_order_independent(kRobot);
}

TEST(Problem, TwoRunOnTwoThreads) {
  const Result alone = oracle::solve(kRobot);
  std::vector<Result> results(2);
  std::vector<std::thread> threads;
  for (Result& result : results) {
    threads.emplace_back([&result] {
      for (int i = 0; i < 5; ++i) result = oracle::solve(kRobot);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Result& result : results) oracle::expect_same(alone, result, "beside another");
}

TEST(Problem, KeepsAndWithstandsEveryRoundingMode) {
  const Result nearest = oracle::solve(kRobot);
  std::fenv_t saved;
  std::fegetenv(&saved);
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for ([[maybe_unused]] const bool flush : {false, true}) {
      Problem p("rounding");
      post_robot(p);
      std::fesetround(mode);
#if defined(__SSE2__)
      if (flush) _mm_setcsr(_mm_getcsr() | 0x8040U);
      const unsigned before = _mm_getcsr() & 0xffc0U;
#endif
      const Result result = p.propagate();
#if defined(__SSE2__)
      const unsigned after = _mm_getcsr() & 0xffc0U;
#endif
      const int left = std::fegetround();
      std::fesetenv(&saved);
      EXPECT_EQ(left, mode);
#if defined(__SSE2__)
      EXPECT_EQ(after, before);
#endif
      oracle::expect_same(nearest, result, "in another rounding mode");
    }
  }
}

TEST(Problem, TheOneEquationAndItsDecompositionAgree) {
  const auto build = [](bool one) {
    return [one](Problem& p) {
      const auto x = p.vector("x", Box{{-1, 1}, {-1, 1}});
      const auto z = p.real("z", {1.5, 3});
      const auto map = p.set("M", 2, 0.25, Box{{-2, 2}, {-2, 2}});
      const VectorExpr a = p.point(2);
      const Expr delta = norm(a - p(x));
      p.constrain("z", p(z) <= 2.0);
      if (one) return p.constrain_range("range", p(z), a, delta, map);
      const auto dug = p.set("D", 2, 0.25);
      p.constrain_union("dug", dug, {2, delta < p(z)});
      p.constrain_disjoint("free", dug, map);
      p.constrain_meets("impact", {2, delta == p(z)}, map);
    };
  };
  const Result one = oracle::solve(build(true)), four = oracle::solve(build(false));
  for (const char* name : {"x", "z", "M"}) EXPECT_TRUE(one[name] == four[name]) << name;
  EXPECT_EQ(one.variables.size(), 3U) << "the dug space is hidden";
}

TEST(Problem, ExplainsByASmallSupport) {
  Problem p("robot");
  post_robot(p);
  const auto w =
      p.tube("w", sampled(p.time_line(), {0.0, 1.0, 2.0}, {Box{{0, 1}}, Box{{5, 6}}, Box{{0, 1}}}));
  p.set_readings(w, {{0, "w, row 1"}, {10, "w, row 2"}, {20, "w, row 3"}});
  p.constrain("low", p.at(w, 1.0)[0] <= 2.0);
  const Result result = p.propagate();
  ASSERT_EQ(result.status, Status::infeasible);
  ASSERT_TRUE(result.explanation.has_value());
  EXPECT_EQ(result.explanation->constraint, "low");
  EXPECT_EQ(result.explanation->variable, "w");
  EXPECT_TRUE(result.explanation->support_is_complete);
  ASSERT_EQ(result.explanation->support.size(), 1U);
  EXPECT_EQ(result.explanation->support[0].source, "w, row 2");
  EXPECT_EQ(result.explanation->support[0].time, 1.0);
}

TEST(Problem, RecordsSnapshotsAndATraceWhenAsked) {
  Problem p("robot");
  post_robot(p);
  PropagationOptions options;
  options.keep_snapshots = options.keep_trace = true;
  const Result result = p.propagate(options);
  ASSERT_EQ(result.snapshots.size(), result.statistics.passes);
  for (std::size_t v = 0; v < result.variables.size(); ++v) {
    EXPECT_TRUE(result.snapshots.back().variables[v].domain == result.variables[v].domain)
        << "the last is the result";
  }
  std::uint64_t calls = 0;
  for (const auto& contractor : result.statistics.contractors) calls += contractor.calls;
  EXPECT_GE(result.trace.size(), calls);
  for (const TraceEntry& entry : result.trace) {
    EXPECT_LE(entry.measure_after, entry.measure_before) << entry.contractor << " on " << entry.variable;
  }
  EXPECT_TRUE(p.propagate().snapshots.empty());
}

}  // namespace
}  // namespace hcsp
