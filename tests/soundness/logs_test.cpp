// SPDX-License-Identifier: Apache-2.0
// Logs as robots write them: irregular stamps counted from an epoch, ranges that are missing or have stamps
// of their own, a time line that mixes stamps with a grid.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/soundness/exact_truth.h"
#include "tests/soundness/slam_case.h"

namespace hcsp::soundness {

namespace {

using slam_simulator::Reading;

struct RealLog {
  Mission mission;
  Log inputs;                        // without ranges
  std::vector<double> range_stamps;  // where there is a range
  std::vector<Box> ranges;
};

RealLog real_log(slam_simulator::Options options) {
  RealLog log{slam_simulator::simulate(options), {}, {}, {}};
  Mission rows = log.mission;
  rows.readings.assign(rows.stamps.size(), {});
  log.inputs = log_of(rows);
  const Interval error = Interval::of_decimal("0.01");
  for (const Reading& reading : log.mission.readings) {
    if (reading.kind != Reading::Kind::value) continue;
    log.range_stamps.push_back(slam_simulator::value(reading.t));
    log.ranges.push_back(
        Box{Interval::of_decimal(slam_simulator::decimal(reading.range)) + join(-error, error)});
  }
  return log;
}

// On the grid of a tenth of a second, joined with every stamp.
Result solve_on_grid(const RealLog& log, double cell_edge) {
  std::vector<double> stamps = log.inputs.stamps;
  stamps.insert(stamps.end(), log.range_stamps.begin(), log.range_stamps.end());
  std::vector<Box> inputs;
  for (std::size_t k = 0; k < log.inputs.stamps.size(); ++k)
    inputs.push_back(Box{log.inputs.speed[k], log.inputs.heading[k]});
  Problem slam("log");
  slam.set_time_line(TimeLine::grid(log.inputs.stamps.front(), log.inputs.stamps.back(), 0.1, stamps));
  const auto line = slam.time_line();
  const auto u = slam.tube("u", hold(line, log.inputs.stamps, inputs));
  const auto z = slam.tube("z", sampled(line, log.range_stamps, log.ranges));
  std::vector<hcsp::Reading> readings;
  for (const double t : log.range_stamps) readings.push_back({*line->gate_at(t), ""});
  slam.set_readings(z, readings);
  const auto x = slam.tube("x", 2);
  const auto map = slam.set("M", 2, cell_edge, Box{{-10, 10}, {-10, 10}});
  const auto dug = slam.set("D", 2, cell_edge);
  const auto a = slam.point(2);
  const auto delta = norm(a - slam(x));
  slam.constrain("start", slam.at(x, line->start()) == VectorExpr{slam.constant(0), slam.constant(0)});
  slam.constrain_derivative("evolution", x, {slam(u)[0] * cos(slam(u)[1]), slam(u)[0] * sin(slam(u)[1])});
  slam.constrain_union("dug", dug, {2, delta < slam(z)[0]});
  slam.constrain_disjoint("free", dug, map);
  slam.constrain_meets("impact", {2, delta == slam(z)[0]}, map);
  return slam.propagate();
}

void expect_sound(const RealLog& log, const Result& result) {
  ASSERT_EQ(result.status, Status::contracted);
  const Tube& x = tube(result, "x");
  const ExactTruth truth(log.mission.truth);
  const auto& t = x.line().instants();
  for (int c = 0; c < 2; ++c) {
    const auto axis = static_cast<std::size_t>(c);
    for (std::size_t i = 0; i < t.size(); ++i) {
      EXPECT_TRUE(truth.at(c, log.mission.truth.row(t[i]), t[i]).in(x.gate(axis, i))) << "gate " << i;
      if (i + 1 == t.size()) break;
      for (int part = 0; part <= 9; ++part) {
        const double time = std::clamp(t[i] + (t[i + 1] - t[i]) * (part / 9.0), t[i], t[i + 1]);
        EXPECT_TRUE(truth.at(c, log.mission.truth.row(time), time).in(x.slice(axis, i))) << "slice " << i;
      }
    }
  }
  const SetInterval &dug = set(result, "D"), &map = set(result, "M");
  for (const auto& wall : log.mission.map) {
    for (int i = 0; i <= 100; ++i) {
      // Readings err by at least half a millionth less than their bound, so what is within a micrometre of a
      // wall is not in D- either: the rounding of this point does not matter.
      const double point[2] = {wall.a.x1 + i / 100.0 * (wall.b.x1 - wall.a.x1),
                               wall.a.x2 + i / 100.0 * (wall.b.x2 - wall.a.x2)};
      EXPECT_NE(dug.at(point), CellState::inside);
      EXPECT_EQ(map.at(point), CellState::unknown);
    }
  }
}

void expect_sound_log(const char* what, const std::function<void(slam_simulator::Options&)>& choose) {
  for (std::uint64_t seed = 1; seed <= (full() ? 20U : 3U); ++seed) {
    SCOPED_TRACE(std::string(what) + ", seed " + std::to_string(seed));
    slam_simulator::Options options;
    options.seed = seed;
    options.duration = 40;
    choose(options);
    const RealLog log = real_log(options);
    const Result result = solve_on_grid(log, 0.1);
    expect_sound(log, result);
    EXPECT_GT(set(result, "D").lower_volume(), 20);
  }
}

}  // namespace

TEST(Logs, Curves) {
  expect_sound_log("curves", [](auto& options) { options.world = "curves"; });
}
TEST(Logs, Jitter) {
  expect_sound_log("jitter", [](auto& options) { options.jitter = true; });
}
TEST(Logs, Epoch) {
  expect_sound_log("epoch", [](auto& options) { options.epoch = 1718000000.25; });
}
TEST(Logs, Blanks) {
  expect_sound_log("blanks", [](auto& options) { options.blank = 0.8; });
}
TEST(Logs, RangesWithTheirOwnStamps) {
  expect_sound_log("own stamps", [](auto& options) { options.range_period = 0.37; });
}
TEST(Logs, Everything) {
  expect_sound_log("everything", [](auto& options) {
    options.world = "random";
    options.jitter = true;
    options.epoch = 1718000000.25;
    options.range_period = 0.23;
    options.blank = 0.5;
    options.max_range = 4;
  });
}

}  // namespace hcsp::soundness
