// SPDX-License-Identifier: Apache-2.0
// No solution is lost, whatever the world: in random worlds the true position is in the tube at every sample
// and at ten instants of every slice, and every point of the true map is in M+ and none in D-.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/soundness/exact_truth.h"
#include "tests/soundness/slam_case.h"

namespace hcsp::soundness {

namespace {

using slam_simulator::Map;
using slam_simulator::Point;
using slam_simulator::Random;

void expect_truth_in_tube(const Tube& x, const ExactTruth& truth) {
  const auto& t = x.line().instants();
  for (int c = 0; c < 2; ++c) {
    const auto axis = static_cast<std::size_t>(c);
    for (std::size_t k = 0; k < t.size(); ++k) {
      EXPECT_TRUE(truth.at_stamp(c, k).in(x.gate(axis, k)))
          << "component " << c << " at " << t[k] << ": " << to_string(x.gate(axis, k));
      if (k + 1 == t.size()) break;
      for (int i = 0; i < 10; ++i) {
        const double time = std::min(std::max(t[k] + (t[k + 1] - t[k]) * (i / 9.0), t[k]), t[k + 1]);
        EXPECT_TRUE(truth.at(c, k, time).in(x.slice(axis, k)))
            << "component " << c << " at " << time << ": " << to_string(x.slice(axis, k));
      }
    }
  }
}

// Calls visit(cell) for the cells that a box touches; the point that the box encloses is in one of them.
template <class Visit>
void for_cells_of(const Grid& grid, const Interval& a1, const Interval& a2, Visit visit) {
  for (auto i2 = grid.cell_of(a2.lo()); i2 <= grid.cell_of(a2.hi()); ++i2) {
    for (auto i1 = grid.cell_of(a1.lo()); i1 <= grid.cell_of(a1.hi()); ++i1) visit(CellIndex{i1, i2, 0});
  }
}

void expect_point_on_map(const SetInterval* dug, const SetInterval& map, const Interval& a1,
                         const Interval& a2) {
  bool free = false, on_map = false;
  for_cells_of(map.grid(), a1, a2, [&](const CellIndex& cell) {
    const CellState state = map.at_cell(cell);
    on_map = on_map || state == CellState::unknown || state == CellState::inside;
    free = free || dug == nullptr || dug->at_cell(cell) != CellState::inside;
  });
  EXPECT_TRUE(free) << "in D-: a point of the map in " << to_string(a1) << " x " << to_string(a2);
  EXPECT_TRUE(on_map) << "not in M+: a point of the map in " << to_string(a1) << " x " << to_string(a2);
}

// Points along every wall, no further apart than `spacing`, and both ends.
void expect_walls_on_map(const SetInterval* dug, const SetInterval& map, const Map& walls, double spacing) {
  for (const auto& wall : walls) {
    const double length = std::hypot(wall.b.x1 - wall.a.x1, wall.b.x2 - wall.a.x2);
    const int n = static_cast<int>(length / spacing) + 1;
    for (int i = 0; i <= n; ++i) {
      const Interval part(static_cast<double>(i) / n);
      expect_point_on_map(dug, map, Interval(wall.a.x1) + part * (Interval(wall.b.x1) - wall.a.x1),
                          Interval(wall.a.x2) + part * (Interval(wall.b.x2) - wall.a.x2));
    }
  }
}

void expect_sound(const Result& result, const Mission& mission, double cell_edge) {
  ASSERT_EQ(result.status, Status::contracted);
  const ExactTruth truth(mission.truth);
  expect_truth_in_tube(tube(result, "x"), truth);
  expect_walls_on_map(&set(result, "D"), set(result, "M"), mission.map, 0.3 * cell_edge);
}

// Intervals with the truth at one of their ends, for runs of samples; elsewhere anywhere in them.
class AtTheBound {
 public:
  explicit AtTheBound(std::uint64_t seed) : random_(seed) {}
  Interval around(const Interval& truth, double error) {
    if (left_-- == 0) {
      left_ = random_.integer(3, 60);
      place_ = random_.integer(0, 2);
    }
    const double below = place_ == 0 ? 0.0 : (place_ == 1 ? 2 * error : random_.in(0, 2 * error));
    return truth + Interval(-below, 2 * error - below);
  }

 private:
  Random random_;
  int left_ = 0, place_ = 0;
};

Log log_at_the_bound(const Mission& mission, double e_speed, double e_heading, double e_range,
                     std::uint64_t seed) {
  AtTheBound speed(3 * seed), heading(3 * seed + 1), range(3 * seed + 2);
  const ExactTruth truth(mission.truth);
  Log log;
  for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
    log.stamps.push_back(mission.truth.t[k]);
    log.speed.push_back(speed.around(mission.truth.speed[k], e_speed));
    log.heading.push_back(heading.around(mission.truth.heading[k], e_heading));
    const Interval d =
        distance_to(mission.map, truth.at_stamp(0, k).enclosure(), truth.at_stamp(1, k).enclosure());
    const bool known = mission.readings[k].kind == slam_simulator::Reading::Kind::value;
    log.range.push_back(known ? std::optional(range.around(d, e_range)) : std::nullopt);
  }
  return log;
}

slam_simulator::Options random_options(std::uint64_t seed, Random& random) {
  slam_simulator::Options options;
  options.world = "random";
  options.seed = seed;
  options.dt = random.chance(0.5) ? 0.1 : (random.chance(0.5) ? 0.25 : 1.0);
  options.duration = random.chance(0.2) ? 100 : random.integer(5, 40);
  options.jitter = random.chance(0.3);
  options.epoch = random.chance(0.2) ? 1.7e9 : 0;
  options.blank = random.chance(0.3) ? 0.8 : 0;
  if (random.chance(0.2)) options.max_range = random.in(1, 5);
  return options;
}

std::uint64_t seeds() { return full() ? 200 : 25; }

std::string rerun(std::uint64_t seed) {
  return "seed " + std::to_string(seed) + " (HCSP_SEED=" + std::to_string(seed) + " runs it alone)";
}

// The seeds to run: 1, 2, ..., or the one in the environment.
template <class Run>
void for_each_seed(std::uint64_t count, Run run) {
  const char* only = std::getenv("HCSP_SEED");
  for (std::uint64_t seed = only != nullptr ? std::stoull(only) : 1, last = only != nullptr ? seed : count;
       seed <= last; ++seed) {
    SCOPED_TRACE(rerun(seed));
    run(seed);
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace

// Noise as the simulator makes it: decimals, with runs of constant error one millionth within the bound.
TEST(Worlds, MeasuredDecimals) {
  for_each_seed(seeds(), [](std::uint64_t seed) {
    Random random(seed);
    const Mission mission = simulate(random_options(seed, random));
    Form form;
    form.cell_edge = random.chance(0.5) ? 0.1 : random.in(0.04, 0.4);
    form.fast_paths = random.chance(0.7);
    expect_sound(solve(log_of(mission), form), mission, form.cell_edge);
  });
}

// Noise exactly at the bound, and bounds of any size, zero among them.
TEST(Worlds, ErrorsAtTheBound) {
  for_each_seed(seeds(), [](std::uint64_t seed) {
    Random random(1000 + seed);
    const Mission mission = simulate(random_options(1000 + seed, random));
    const double scale = random.chance(0.2) ? 0 : std::exp2(random.in(-6, 2));
    const Log log =
        log_at_the_bound(mission, 0.01 * scale, 0.01 * scale, 0.01 * (random.chance(0.2) ? 0 : scale), seed);
    Form form;
    form.cell_edge = random.chance(0.5) ? 0.1 : random.in(0.04, 0.4);
    expect_sound(solve(log, form), mission, form.cell_edge);
  });
}

// The room with many seeds of the noise, where loops close and the tube is contracted most.
TEST(Worlds, RoomAndCurves) {
  for_each_seed(full() ? 50 : 6, [](std::uint64_t seed) {
    slam_simulator::Options options;
    options.world = seed % 3 == 0 ? "curves" : "room";
    options.seed = seed;
    options.dt = seed % 2 == 0 ? 0.1 : 0.5;
    const Mission mission = simulate(options);
    Form form;
    form.cell_edge = seed % 2 == 0 ? 0.1 : 0.05;
    const Log log = seed % 4 < 2 ? log_of(mission) : log_at_the_bound(mission, 0.01, 0.01, 0.01, seed);
    expect_sound(solve(log, form), mission, form.cell_edge);
  });
}

// Rangefinders that only the general path knows.
TEST(Worlds, OtherSensors) {
  for_each_seed(full() ? 60 : 9, [](std::uint64_t seed) {
    Random random(2000 + seed);
    slam_simulator::Options options;
    options.world = seed % 2 == 0 ? "random" : "room";
    options.seed = 2000 + seed;
    options.dt = 0.5;
    options.duration = 60;
    if (seed % 3 == 0) options.half_angle = random.in(0.3, 1.5);
    Mission mission = simulate(options);
    Map stretched = mission.map;
    for (auto& wall : stretched) wall = {{wall.a.x1, 2 * wall.a.x2}, {wall.b.x1, 2 * wall.b.x2}};
    slam_simulator::Noise noise(0.01, true, seed);
    const double ahead = random.in(-1, 1), left = random.in(-1, 1);
    for (std::size_t k = 0; k < mission.stamps.size() && seed % 3 != 0; ++k) {
      const Point x = mission.truth.x[k];
      const double c = std::cos(mission.truth.heading[k]), s = std::sin(mission.truth.heading[k]);
      mission.readings[k].range = noise.measure(
          seed % 3 == 1 ? distance({x.x1, 2 * x.x2}, stretched)
                        : distance({x.x1 + c * ahead - s * left, x.x2 + s * ahead + c * left}, mission.map));
    }
    Form form;
    form.cell_edge = 0.2;
    Zones zones = zones_of([&](const VectorExpr& a, const VectorExpr& x, Expr heading) {
      const Expr c = cos(heading), s = sin(heading);
      if (seed % 3 == 1) return sqrt(sqr(a[0] - x[0]) + Interval(4.0) * sqr(a[1] - x[1]));
      return norm(VectorExpr{a[0] - x[0] - (c * ahead - s * left), a[1] - x[1] - (s * ahead + c * left)});
    });
    if (options.half_angle) {
      const auto sees = [&](const VectorExpr& a, const VectorExpr& x, Expr h) {
        const VectorExpr d = a - x;
        return cos(h) * d[0] + sin(h) * d[1] >= cos(Interval(*options.half_angle)) * norm(d);
      };
      zones = {[&](const VectorExpr& a, const VectorExpr& x, Expr h, Expr z) {
                 return sees(a, x, h) && norm(a - x) < z;
               },
               [&](const VectorExpr& a, const VectorExpr& x, Expr h, Expr z) {
                 return sees(a, x, h) && norm(a - x) == z;
               }};
      EXPECT_TRUE(solve(log_of(mission), form, zones).status == Status::contracted);
      expect_sound(solve(log_of(mission), form, zones), mission, form.cell_edge);
      return;
    }
    expect_sound(solve(log_of(mission), form, zones), mission, form.cell_edge);
  });
}

}  // namespace hcsp::soundness
