// SPDX-License-Identifier: Apache-2.0
#include "tests/soundness/slam_case.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hcsp::soundness {

namespace {

Interval around(const std::string& text, const char* error) {
  const Interval bound = Interval::of_decimal(error);
  return Interval::of_decimal(text) + join(-bound, bound);
}

}  // namespace

Log log_of(const Mission& mission, const char* e_speed, const char* e_heading, const char* e_range) {
  using slam_simulator::decimal;
  Log log;
  for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
    log.stamps.push_back(slam_simulator::value(mission.stamps[k]));
    log.speed.push_back(around(decimal(mission.speed[k]), e_speed));
    log.heading.push_back(around(decimal(mission.heading[k]), e_heading));
    const auto& reading = mission.readings[k];
    const bool known = reading.kind == slam_simulator::Reading::Kind::value;
    log.range.push_back(known ? std::optional(around(decimal(reading.range), e_range)) : std::nullopt);
  }
  return log;
}

Log read_log(const std::string& name) {
  std::ifstream file(std::string(HCSP_SOURCE_DIR) + "/models/slam/" + name);
  if (!file) throw std::runtime_error("cannot read " + name);
  Log log;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::vector<std::string> cells(4);
    for (std::string& cell : cells) std::getline(row, cell, ',');
    log.stamps.push_back(std::stod(cells[0]));
    log.speed.push_back(around(cells[1], "0.01"));
    log.heading.push_back(around(cells[2], "0.01"));
    log.range.push_back(cells[3].empty() ? std::nullopt : std::optional(around(cells[3], "0.01")));
  }
  return log;
}

Zones zones_of(DeltaOf delta) {
  return {[delta](const VectorExpr& a, const VectorExpr& x, Expr heading, Expr z) {
            return delta(a, x, heading) < z;
          },
          [delta](const VectorExpr& a, const VectorExpr& x, Expr heading, Expr z) {
            return delta(a, x, heading) == z;
          }};
}

DeltaOf distance() {
  return [](const VectorExpr& a, const VectorExpr& x, Expr) { return norm(a - x); };
}

std::unique_ptr<Problem> problem_of(const Log& log, const Form& form, const Zones& zones, DeltaOf delta) {
  auto problem = std::make_unique<Problem>("slam");
  Problem& slam = *problem;
  slam.use_fast_paths(form.fast_paths);
  slam.set_time_line(TimeLine(log.stamps));
  const auto line = slam.time_line();
  std::vector<Box> inputs, ranges;
  std::vector<double> range_stamps;
  std::vector<Reading> readings;
  for (std::size_t k = 0; k < log.stamps.size(); ++k) {
    inputs.push_back(Box{log.speed[k], log.heading[k]});
    if (!log.range[k]) continue;
    range_stamps.push_back(log.stamps[k]);
    ranges.push_back(Box{*log.range[k]});
    readings.push_back({k, ""});
  }
  const auto u = slam.tube(form.names[0], hold(line, log.stamps, inputs));
  const auto z =
      slam.tube(form.names[1], ranges.empty() ? Tube(line, 1) : sampled(line, range_stamps, ranges));
  slam.set_readings(z, std::move(readings));
  const auto x = slam.tube(form.names[2], 2);
  const auto map = slam.set(form.names[3], 2, form.cell_edge, form.bound_of_map);
  const auto a = slam.point(2);
  const auto heading = slam(u)[1];
  std::optional<SetVariable> dug;
  if (!form.one_equation) dug = slam.set(form.names[4], 2, form.cell_edge, form.bound_of_dug);
  for (const int which : form.posting) {
    if (which == 0)
      slam.constrain("start",
                     slam.at(x, log.stamps.front()) == VectorExpr{slam.constant(0), slam.constant(0)});
    if (which == 1)
      slam.constrain_derivative("evolution", x, {slam(u)[0] * cos(heading), slam(u)[0] * sin(heading)});
    if (which == 2 && form.one_equation)
      slam.constrain_range("map", slam(z)[0], a, delta(a, slam(x), heading), map);
    if (form.one_equation) continue;
    if (which == 2) slam.constrain_union("dug", *dug, {2, zones.digs(a, slam(x), heading, slam(z)[0])});
    if (which == 3) slam.constrain_disjoint("free", *dug, map);
    if (which == 4) slam.constrain_meets("impact", {2, zones.hits(a, slam(x), heading, slam(z)[0])}, map);
  }
  return problem;
}

Result solve(const Log& log, const Form& form, const Zones& zones, const PropagationOptions& options) {
  return problem_of(log, form, zones)->propagate(options);
}

Result solve(const Log& log, const Form& form, const PropagationOptions& options) {
  return problem_of(log, form, zones_of(distance()), distance())->propagate(options);
}

const Tube& tube(const Result& result, const char* name) { return std::get<Tube>(result[name]); }
const SetInterval& set(const Result& result, const char* name) { return std::get<SetInterval>(result[name]); }

double dug_area_within(const SetInterval& dug, const naive::Solution& frame) {
  std::int64_t cells = 0;
  for (std::int64_t i2 = frame.first; i2 < frame.first + frame.count; ++i2) {
    for (std::int64_t i1 = frame.first; i1 < frame.first + frame.count; ++i1) {
      cells += dug.at_cell({i1, i2, 0}) == CellState::inside ? 1 : 0;
    }
  }
  return static_cast<double>(cells) * frame.cell_edge * frame.cell_edge;
}

bool full() {
  const char* value = std::getenv("HCSP_FULL");
  return value != nullptr && std::string(value) == "1";
}

}  // namespace hcsp::soundness
