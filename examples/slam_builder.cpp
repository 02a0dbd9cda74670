// SPDX-License-Identifier: Apache-2.0
// Range-only SLAM with an occupancy map (Jaulin, IEEE T-RO 27(5), 2011), built with the C++ API alone: the
// same problem as models/slam/slam.hcsp, and the same sets, cell by cell.
//   slam_builder LOG.csv [--eps 0.05] [--general] [--json FILE]     (columns t, speed, heading, range)
#include <hcsp/hcsp.h>
#include <hcsp/solver/report/json.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Log {
  std::vector<double> stamps;
  std::vector<hcsp::Box> speed_and_heading;
  std::vector<double> range_stamps;
  std::vector<hcsp::Box> ranges;
};

// A decimal in the file is the real number that is written: the tightest interval around it.
Log read_log(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  Log log;
  std::string line;
  std::getline(file, line);  // t,speed,heading,range
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells.size() < 3) continue;
    const double t = std::stod(cells[0]);
    log.stamps.push_back(t);
    const hcsp::Interval error_u =
        hcsp::join(-hcsp::Interval::of_decimal("0.01"), hcsp::Interval::of_decimal("0.01"));
    log.speed_and_heading.push_back(
        {hcsp::Interval::of_decimal(cells[1]) + error_u, hcsp::Interval::of_decimal(cells[2]) + error_u});
    if (cells.size() < 4 || cells[3].empty()) continue;  // no reading
    log.range_stamps.push_back(t);
    log.ranges.push_back({hcsp::Interval::of_decimal(cells[3]) + error_u});
  }
  return log;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: slam_builder LOG.csv [--eps E] [--general] [--json FILE]\n";
    return 2;
  }
  double eps = 0.05;
  bool general = false;
  std::string json;
  for (int i = 2; i < argc; ++i) {
    if (std::string(argv[i]) == "--eps" && i + 1 < argc) eps = std::atof(argv[++i]);
    if (std::string(argv[i]) == "--general") general = true;
    if (std::string(argv[i]) == "--json" && i + 1 < argc) json = argv[++i];
  }
  const Log log = read_log(argv[1]);

  hcsp::Problem slam("range_only_slam");
  if (general) slam.use_fast_paths(false);
  slam.set_time_line(hcsp::TimeLine::grid(0, log.stamps.back(), 0.1, log.stamps));
  const auto line = slam.time_line();
  const auto u = slam.tube("u", hcsp::hold(line, log.stamps, log.speed_and_heading));
  const auto z = slam.tube("z", hcsp::sampled(line, log.range_stamps, log.ranges));
  std::vector<hcsp::Reading> readings;
  for (const double t : log.range_stamps) readings.push_back({*line->gate_at(t), ""});
  slam.set_readings(z, std::move(readings));

  const auto x = slam.tube("x", 2);
  const auto M = slam.set("M", 2, eps, hcsp::Box{{-10, 10}, {-10, 10}});
  const auto D = slam.set("D", 2, eps);

  const auto a = slam.point(2);
  const auto delta = norm(a - slam(x));
  slam.constrain("start", slam.at(x, 0.0) == hcsp::VectorExpr{slam.constant(0), slam.constant(0)});
  slam.constrain_derivative("evolution", x, {slam(u)[0] * cos(slam(u)[1]), slam(u)[0] * sin(slam(u)[1])});
  slam.constrain_union("dug", D, {2, delta < slam(z)[0]});
  slam.constrain_disjoint("free", D, M);
  slam.constrain_meets("impact", {2, delta == slam(z)[0]}, M);

  const hcsp::Result result = slam.propagate();
  if (!json.empty()) std::ofstream(json) << hcsp::to_json(result);
  std::cout << "status " << hcsp::to_string(result.status) << ", " << result.statistics.passes << " passes, "
            << 1e3 * result.statistics.seconds << " ms\n";
  for (const auto& contractor : result.statistics.contractors) {
    std::cout << "  " << contractor.name << ": " << contractor.calls << " calls, " << 1e3 * contractor.seconds
              << " ms\n";
  }
  if (result.explanation) {
    std::cout << "no solution: " << result.explanation->constraint << ", " << result.explanation->variable
              << ", " << result.explanation->support.size() << " readings in conflict\n";
    return 0;
  }
  std::cout << "mean width of x " << measure(std::get<hcsp::Tube>(result["x"])) << " m, D- "
            << std::get<hcsp::SetInterval>(result["D"]).lower_volume() << " m2, M+ "
            << std::get<hcsp::SetInterval>(result["M"]).upper_volume() << " m2\n";
  return 0;
}
