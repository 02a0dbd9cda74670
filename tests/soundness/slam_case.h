// SPDX-License-Identifier: Apache-2.0
// Range-only SLAM for tests: simulated missions, the logs that they leave, and the problem that hcsp solves.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/slam_simulator.h"
#include "solver/problem.h"
#include "tests/support/naive_slam.h"

namespace hcsp::soundness {

using slam_simulator::Mission;
using Log = naive::Log;

/// What the mission's written decimals say, with the bounds of their errors around them.
Log log_of(const Mission& mission, const char* e_speed = "0.01", const char* e_heading = "0.01",
           const char* e_range = "0.01");

/// A row of shipped measurements.
Log read_log(const std::string& name);

/// The expressions of a rangefinder: the zone that it digs and the zone that it hits, of a point a seen from
/// x with a heading and a range.
struct Zones {
  std::function<Expr(const VectorExpr&a, const VectorExpr&x, Expr heading, Expr z)> digs, hits;
};
/// delta(a) < z and delta(a) == z.
using DeltaOf = std::function<Expr(const VectorExpr& a, const VectorExpr& x, Expr heading)>;
Zones zones_of(DeltaOf delta);
DeltaOf distance();

/// How the problem is put to hcsp.
struct Form {
  double cell_edge = 0.1;
  bool fast_paths = true;
  bool one_equation = false;                   ///< z(t) == distance(x(t), M) instead of the four constraints
  std::optional<Box> bound_of_dug;             ///< nothing of D is outside
  std::vector<int> posting = {0, 1, 2, 3, 4};  ///< the order: start, evolution, dug, free, impact
  std::optional<Box> bound_of_map = Box{{-10, 10}, {-10, 10}};
  std::vector<std::string> names = {"u", "z", "x", "M", "D"};
};

std::unique_ptr<Problem> problem_of(const Log& log, const Form& form, const Zones& zones, DeltaOf delta = {});
Result solve(const Log& log, const Form& form, const Zones& zones, const PropagationOptions& options = {});
/// With the Euclidean distance.
Result solve(const Log& log, const Form& form = {}, const PropagationOptions& options = {});

const Tube& tube(const Result& result, const char* name);
const SetInterval& set(const Result& result, const char* name);

/// The area of D-, counted over the cells of the naive solver.
double dug_area_within(const SetInterval& dug, const naive::Solution& frame);

/// Whether long runs are asked for: HCSP_FULL=1 in the environment.
bool full();

}  // namespace hcsp::soundness
