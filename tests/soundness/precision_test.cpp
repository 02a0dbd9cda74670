// SPDX-License-Identifier: Apache-2.0
// Nothing passes by being vague: the domains are as tight as those of the naive solver on the same data and
// cells, and not tighter either, for the Euclidean rangefinder and for others that only the general path
// knows.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/soundness/slam_case.h"

namespace hcsp::soundness {

namespace {

using slam_simulator::Point;

Interval number(const char* text) { return Interval::of_decimal(text); }

// A mission with two samples a second.
Mission mission_in(const std::string& world, double duration = 60, std::uint64_t seed = 1,
                   std::optional<double> half_angle = {}) {
  slam_simulator::Options options;
  options.world = world;
  options.seed = seed;
  options.dt = 0.5;
  options.duration = duration;
  options.half_angle = half_angle;
  return slam_simulator::simulate(options);
}

// Replaces the ranges by those of another sensor.
void measure_again(Mission& mission, const std::function<double(Point x, double heading)>& range) {
  slam_simulator::Noise noise(0.01, true, 4711);
  for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
    mission.readings[k].kind = slam_simulator::Reading::Kind::value;
    mission.readings[k].range = noise.measure(range(mission.truth.x[k], mission.truth.heading[k]));
  }
}

void expect_as_tight(const Result& result, const naive::Solution& plain, const std::string& what) {
  ASSERT_EQ(result.status, Status::contracted) << what;
  ASSERT_TRUE(plain.feasible) << what;
  const double width = measure(tube(result, "x")), dug = dug_area_within(set(result, "D"), plain);
  const double map = set(result, "M").upper_volume();
  std::printf("%s: mean width %.6f (naive %.6f), D- %.4f (%.4f), M+ %.4f (%.4f), %.1f ms, %d naive passes\n",
              what.c_str(), width, plain.mean_width(), dug, plain.dug_area(), map, plain.map_area(),
              1e3 * result.statistics.seconds, plain.passes);
  EXPECT_LE(width, 1.02 * plain.mean_width()) << what;
  EXPECT_GE(dug, 0.99 * plain.dug_area()) << what;
  EXPECT_LE(map, 1.02 * plain.map_area()) << what;
  // Much tighter would be suspect. The plain cone learns nothing of x from the angle, hcsp does,
  // and digs with it.
  EXPECT_GE(width, 0.9 * plain.mean_width()) << what;
  EXPECT_LE(dug, 1.03 * plain.dug_area()) << what;
}

struct Variant {
  std::string name;
  Mission mission;
  Log log;
  naive::Sensor sensor;
  Zones zones;
};

Variant plain_variant(const std::string& name, Mission mission, naive::Sensor sensor, DeltaOf delta) {
  Log log = log_of(mission);
  return {name, std::move(mission), std::move(log), std::move(sensor), zones_of(std::move(delta))};
}

Variant euclidean(const std::string& world, std::uint64_t seed = 1) {
  return plain_variant(world + " " + std::to_string(seed), mission_in(world, 60, seed), naive::euclidean(),
                       distance());
}

// The norm written out, with products for squares: the same sensor, another expression.
Variant written_out() {
  return plain_variant("written out", mission_in("room"), naive::euclidean(),
                       [](const VectorExpr& a, const VectorExpr& x, Expr) {
                         const VectorExpr d = x - a;
                         return sqrt(d[1] * d[1] + d[0] * d[0]);
                       });
}

Variant doubled() {
  Variant variant = plain_variant(
      "doubled", mission_in("room"), naive::doubled(),
      [](const VectorExpr& a, const VectorExpr& x, Expr) { return Interval(2.0) * norm(a - x); });
  for (auto& range : variant.log.range) range = Interval(2.0) * *range;
  return variant;
}

Variant off_centre() {
  constexpr double kAhead = 0.5, kLeft = -0.25;
  Mission mission = mission_in("room", 100);
  measure_again(mission, [&](Point x, double heading) {
    const double c = std::cos(heading), s = std::sin(heading);
    return distance({x.x1 + c * kAhead - s * kLeft, x.x2 + s * kAhead + c * kLeft}, mission.map);
  });
  return plain_variant("off centre", mission, naive::off_centre(kAhead, kLeft),
                       [](const VectorExpr& a, const VectorExpr& x, Expr heading) {
                         const Expr c = cos(heading), s = sin(heading);
                         return norm(VectorExpr{a[0] - (x[0] + (c * kAhead - s * kLeft)),
                                                a[1] - (x[1] + (s * kAhead + c * kLeft))});
                       });
}

Variant elliptic() {
  Mission mission = mission_in("room");
  slam_simulator::Map stretched = mission.map;
  for (auto& wall : stretched) wall = {{wall.a.x1, 2 * wall.a.x2}, {wall.b.x1, 2 * wall.b.x2}};
  measure_again(mission, [&](Point x, double) { return distance({x.x1, 2 * x.x2}, stretched); });
  return plain_variant("elliptic", mission, naive::elliptic(),
                       [](const VectorExpr& a, const VectorExpr& x, Expr) {
                         return sqrt(sqr(a[0] - x[0]) + Interval(4.0) * sqr(a[1] - x[1]));
                       });
}

// models/slam/aperture.hcsp
Variant cone() {
  Variant variant = plain_variant("cone", mission_in("room", 100, 1, 1.4), naive::cone(1.4), distance());
  const auto in_cone = [](const VectorExpr& a, const VectorExpr& x, Expr heading) {
    const VectorExpr d = a - x;
    return cos(heading) * d[0] + sin(heading) * d[1] >= cos(number("1.4")) * norm(d);
  };
  variant.zones = {[=](const VectorExpr& a, const VectorExpr& x, Expr h, Expr z) {
                     return in_cone(a, x, h) && norm(a - x) < z;
                   },
                   [=](const VectorExpr& a, const VectorExpr& x, Expr h, Expr z) {
                     return in_cone(a, x, h) && norm(a - x) == z;
                   }};
  return variant;
}

void compare(const Variant& variant, double cell_edge) {
  Form form;
  form.cell_edge = cell_edge;
  expect_as_tight(solve(variant.log, form, variant.zones),
                  naive::solve(variant.log, variant.sensor, cell_edge), variant.name);
}

}  // namespace

TEST(Precision, Room) { compare(euclidean("room"), 0.2); }
TEST(Precision, Curves) { compare(euclidean("curves"), 0.2); }
TEST(Precision, RandomWorlds) {
  for (const std::uint64_t seed : {3, 14, 15}) compare(euclidean("random", seed), 0.25);
}
TEST(Precision, NormWrittenOut) { compare(written_out(), 0.2); }
TEST(Precision, Doubled) { compare(doubled(), 0.2); }
TEST(Precision, OffCentre) { compare(off_centre(), 0.2); }
TEST(Precision, Elliptic) { compare(elliptic(), 0.2); }
TEST(Precision, Cone) { compare(cone(), 0.2); }

// The fast path and the plain one make the same decisions: nothing differs, bit for bit.
TEST(Precision, EqualBitForBit) {
  const Variant variant = euclidean("room");
  Form form;
  form.cell_edge = 0.2;
  const Result result = solve(variant.log, form);
  const naive::Solution plain = naive::solve(variant.log, variant.sensor, 0.2);
  const Tube& x = tube(result, "x");
  for (std::size_t k = 0; k < plain.gates.size(); ++k) {
    EXPECT_EQ(x.gate(0, k), plain.gates[k].x1);
    EXPECT_EQ(x.gate(1, k), plain.gates[k].x2);
    EXPECT_EQ(tube(result, "z").gate(0, k), plain.gates[k].z);
  }
  for (std::int64_t i2 = plain.first; i2 < plain.first + plain.count; ++i2) {
    for (std::int64_t i1 = plain.first; i1 < plain.first + plain.count; ++i1) {
      EXPECT_EQ(set(result, "D").at_cell({i1, i2, 0}) == CellState::inside, plain.is_dug(i1, i2));
      EXPECT_EQ(set(result, "M").at_cell({i1, i2, 0}) == CellState::outside, plain.is_dug(i1, i2));
    }
  }
}

// The shipped data at the cell sizes of the models: minutes, on request only.
TEST(Precision, ShippedData) {
  if (!full()) GTEST_SKIP() << "HCSP_FULL=1 runs it";
  for (const double cell_edge : {0.1, 0.05}) {
    for (const char* data : {"room.csv", "curves.csv"}) {
      const Log log = read_log(data);
      compare({std::string(data) + " " + std::to_string(cell_edge),
               {},
               log,
               naive::euclidean(),
               zones_of(distance())},
              cell_edge);
    }
  }
}

}  // namespace hcsp::soundness
