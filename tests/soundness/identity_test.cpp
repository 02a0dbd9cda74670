// SPDX-License-Identifier: Apache-2.0
// One problem, one answer: however it is written and in whatever order it is propagated, the domains are the
// same bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/soundness/slam_case.h"

namespace hcsp::soundness {

namespace {

Mission mission_in(const std::string& world, double dt, std::uint64_t seed = 5) {
  slam_simulator::Options options;
  options.world = world;
  options.seed = seed;
  options.dt = dt;
  return slam_simulator::simulate(options);
}

const Log& room() {
  static const Log log = log_of(mission_in("room", 0.25));
  return log;
}

bool same_bits(const Tube& a, const Tube& b) {
  if (a.is_empty() || b.is_empty() || a.dim() != b.dim() || a.items() != b.items()) return false;
  for (std::size_t c = 0; c < a.dim(); ++c) {
    if (!std::equal(a.lo(c), a.lo(c) + a.items(), b.lo(c)) ||
        !std::equal(a.hi(c), a.hi(c) + a.items(), b.hi(c)))
      return false;
  }
  return true;
}

bool same_cells(const SetInterval& a, const SetInterval& b) {
  return !a.is_empty() && !b.is_empty() && a == b && a.background() == b.background() &&
         a.lower_volume() == b.lower_volume() && a.upper_volume() == b.upper_volume();
}

void expect_same(const Result& a, const Result& b, const std::string& what, bool with_dug = true) {
  EXPECT_EQ(a.status, b.status) << what;
  EXPECT_TRUE(same_bits(tube(a, "x"), tube(b, "x"))) << what << ": x differs";
  EXPECT_TRUE(same_bits(tube(a, "z"), tube(b, "z"))) << what << ": z differs";
  EXPECT_TRUE(same_bits(tube(a, "u"), tube(b, "u"))) << what << ": u differs";
  EXPECT_TRUE(same_cells(set(a, "M"), set(b, "M"))) << what << ": M differs";
  EXPECT_TRUE(!with_dug || same_cells(set(a, "D"), set(b, "D"))) << what << ": D differs";
}

const Box kWide{{-25, 25}, {-25, 25}};

// The flagship, and the same with a bound on D, where every backward path is at work.
std::vector<Form> forms() {
  Form plain, bounded;
  bounded.bound_of_dug = kWide;
  bounded.cell_edge = 0.2;
  return {plain, bounded};
}

}  // namespace

TEST(Identity, FastPathsChangeNothing) {
  for (Form form : forms()) {
    const Result fast = solve(room(), form);
    form.fast_paths = false;
    expect_same(fast, solve(room(), form), "general path");
  }
  Form tight;  // a bound that cuts into what the sensor reaches
  tight.cell_edge = 0.2;
  tight.bound_of_dug = Box{{-9.6, 9.6}, {-9.6, 9.6}};
  const Result fast = solve(room(), tight);
  tight.fast_paths = false;
  expect_same(fast, solve(room(), tight), "general path, tight bound");
}

TEST(Identity, OneEquationOrFourConstraints) {
  for (const bool fast : {true, false}) {
    Form form;
    form.fast_paths = fast;
    const Result four = solve(room(), form);
    form.one_equation = true;
    expect_same(four, solve(room(), form), "one equation", false);
  }
}

TEST(Identity, AnyOrderOfPosting) {
  for (Form form : forms()) {
    const Result expected = solve(room(), form);
    slam_simulator::Random random(7);
    for (int i = 0; i < 8; ++i) {
      for (std::size_t k = 4; k > 0; --k) {
        std::swap(form.posting[k],
                  form.posting[static_cast<std::size_t>(random.integer(0, static_cast<int>(k)))]);
      }
      std::string what = "posted";
      for (const int which : form.posting) what.append(1, ' ').append(std::to_string(which));
      expect_same(expected, solve(room(), form), what);
    }
  }
}

TEST(Identity, AnyOrderOfSchedulingAndEveryRun) {
  for (const Form& form : forms()) {
    const auto problem = problem_of(room(), form, zones_of(distance()), distance());
    const Result expected = problem->propagate();
    expect_same(expected, problem->propagate(), "second run");
    PropagationOptions options;
    options.order = Order::reversed;
    expect_same(expected, problem->propagate(options), "reversed");
    options.order = Order::shuffled;
    for (options.seed = 1; options.seed <= 6; ++options.seed) {
      expect_same(expected, problem->propagate(options),
                  "shuffled with seed " + std::to_string(options.seed));
    }
    expect_same(expected, problem->propagate(), "last run");
  }
}

TEST(Identity, NamesMeanNothing) {
  Form form;
  const Result expected = solve(room(), form);
  form.names = {"odometry", "M", "z", "grid", "u"};
  const Result renamed = solve(room(), form);
  EXPECT_TRUE(same_bits(tube(expected, "x"), tube(renamed, "z")));
  EXPECT_TRUE(same_bits(tube(expected, "z"), tube(renamed, "M")));
  EXPECT_TRUE(same_cells(set(expected, "M"), set(renamed, "grid")));
  EXPECT_TRUE(same_cells(set(expected, "D"), set(renamed, "u")));
}

// Random worlds, with the bound on D taken at random: it may cut the world short, and the answer may be
// "infeasible", but it is the same answer.
TEST(Identity, RandomWorlds) {
  for (std::uint64_t seed = 1; seed <= (full() ? 100U : 12U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    slam_simulator::Random random(seed);
    const Log log = log_of(mission_in("random", 1.0, 9000 + seed));
    Form form;
    form.cell_edge = random.in(0.1, 0.4);
    if (random.chance(0.6)) {
      const double reach = random.in(6, 20);
      form.bound_of_dug = Box{{-reach, reach}, {-reach, reach}};
    }
    const Result expected = solve(log, form);
    PropagationOptions options;
    options.order = Order::shuffled;
    options.seed = seed;
    const Result shuffled = solve(log, form, options);
    form.fast_paths = false;
    const Result general = solve(log, form);
    ASSERT_EQ(expected.status, shuffled.status);
    ASSERT_EQ(expected.status, general.status);
    if (expected.status == Status::infeasible) continue;
    expect_same(expected, shuffled, "shuffled");
    expect_same(expected, general, "general path");
  }
}

}  // namespace hcsp::soundness
