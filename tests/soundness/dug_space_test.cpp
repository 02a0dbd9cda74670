// SPDX-License-Identifier: Apache-2.0
// The upper bound of the dug space: nothing is known of it in the flagship; where the model states one, it
// bounds x and z in turn.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/soundness/exact_truth.h"
#include "tests/soundness/slam_case.h"

namespace hcsp::soundness {

namespace {

Mission room_mission(double duration, double dt) {
  slam_simulator::Options options;
  options.seed = 11;
  options.dt = dt;
  options.duration = duration;
  return slam_simulator::simulate(options);
}

// A box that contains the discs that the robot really dug, with a margin.
Box around_dug_space(const Mission& mission, double margin) {
  Interval x1 = Interval::empty(), x2 = Interval::empty();
  for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
    const auto p = mission.truth.x[k];
    const double reach = distance(p, mission.map) + margin;
    x1 = join(x1, Interval(p.x1 - reach, p.x1 + reach));
    x2 = join(x2, Interval(p.x2 - reach, p.x2 + reach));
  }
  return {x1, x2};
}

void expect_truth_inside(const Result& result, const Mission& mission) {
  const ExactTruth truth(mission.truth);
  for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
    for (int c = 0; c < 2; ++c) {
      EXPECT_TRUE(truth.at_stamp(c, k).in(tube(result, "x").gate(static_cast<std::size_t>(c), k)))
          << "x at sample " << k;
    }
    const Interval range =
        distance_to(mission.map, truth.at_stamp(0, k).enclosure(), truth.at_stamp(1, k).enclosure());
    EXPECT_FALSE(meet(range, tube(result, "z").gate(0, k)).is_empty()) << "z at sample " << k;
  }
}

}  // namespace

TEST(DugSpace, UnknownBeyondWhatIsDug) {
  for (const bool fast : {true, false}) {
    Form form;
    form.fast_paths = fast;
    const Result result = solve(log_of(room_mission(100, 0.25)), form);
    const SetInterval& dug = set(result, "D");
    EXPECT_EQ(dug.background(), CellState::unknown);
    EXPECT_FALSE(dug.has_outside());
    EXPECT_TRUE(dug.cells(CellState::outside).empty());
    EXPECT_EQ(dug.upper_volume(), kInfinity);
    EXPECT_GT(dug.lower_volume(), 100);
    EXPECT_EQ(set(result, "M").background(), CellState::outside);
    EXPECT_EQ(set(result, "M").lower_volume(), 0.0);
  }
}

// A bound of D that the truth respects narrows x and z, and keeps the truth.
TEST(DugSpace, ABoundContractsBackward) {
  const Mission mission = room_mission(60, 0.5);
  const Log log = log_of(mission);
  for (const bool fast : {true, false}) {
    Form form;
    form.cell_edge = 0.1;
    form.fast_paths = fast;
    const Result free = solve(log, form);
    form.bound_of_dug = around_dug_space(mission, 1e-6);
    const Result bounded = solve(log, form);
    ASSERT_EQ(bounded.status, Status::contracted);
    expect_truth_inside(bounded, mission);
    int narrower_x = 0, narrower_z = 0;
    for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
      for (std::size_t c = 0; c < 2; ++c) {
        const Interval is = tube(bounded, "x").gate(c, k), was = tube(free, "x").gate(c, k);
        EXPECT_TRUE(leq(is, was));
        narrower_x += is.width() < was.width() ? 1 : 0;
      }
      const Interval is = tube(bounded, "z").gate(0, k), was = tube(free, "z").gate(0, k);
      EXPECT_TRUE(leq(is, was));
      narrower_z += is.width() < was.width() ? 1 : 0;
    }
    std::printf("bound on D: x narrower at %d of %zu gates, z at %d\n", narrower_x, 2 * mission.stamps.size(),
                narrower_z);
    EXPECT_GT(narrower_x, 0);
    EXPECT_LT(measure(tube(bounded, "x")), measure(tube(free, "x")));
    EXPECT_EQ(set(bounded, "D").background(), CellState::outside);
    EXPECT_LT(set(bounded, "D").upper_volume(), kInfinity);
  }
}

// z itself: a robot that knows where it stands, a poor rangefinder, and a wall that D does not reach.
TEST(DugSpace, ABoundContractsTheRange) {
  Problem slam("bounded");
  slam.set_time_line(TimeLine({0, 1}));
  const auto line = slam.time_line();
  const auto z = slam.tube("z", sampled(line, {0, 1}, {Box{{1, 5}}, Box{{1, 5}}}));
  slam.set_readings(z, {{0, ""}, {1, ""}});
  const auto x = slam.tube("x", 2);
  const auto dug = slam.set("D", 2, 0.125, Box{{-2, 4}, {-4, 4}});
  const auto a = slam.point(2);
  slam.constrain("at rest", slam.at(x, 0) == VectorExpr{slam.constant(0), slam.constant(0)});
  slam.constrain_derivative("no motion", x, {slam.constant(0), slam.constant(0)});
  slam.constrain_union("dug", dug, {2, norm(a - slam(x)) < slam(z)[0]});
  const Result result = slam.propagate();
  ASSERT_EQ(result.status, Status::contracted);
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_EQ(tube(result, "z").gate(0, k).lo(), 1);
    EXPECT_GE(tube(result, "z").gate(0, k).hi(), 2);  // z = 2 has a solution: the zone is open
    EXPECT_LE(tube(result, "z").gate(0, k).hi(), 2.01);
  }
}

// A bound that the truth does not respect leaves nothing.
TEST(DugSpace, ABoundThatCannotHold) {
  const Mission mission = room_mission(20, 0.5);
  Form form;
  form.bound_of_dug = Box{{-1, 1}, {-1, 1}};
  const Result result = solve(log_of(mission), form);
  EXPECT_EQ(result.status, Status::infeasible);
  ASSERT_TRUE(result.explanation.has_value());
  EXPECT_LE(result.explanation->support.size(), 2U);
}

}  // namespace hcsp::soundness
