// SPDX-License-Identifier: Apache-2.0
// Writes data for range-only SLAM: NAME.csv (what the robot measured), NAME_truth.csv (where it was) and
// NAME_map.csv (the walls). Needs nothing but the standard library: g++ -std=c++20 -O2 simulate_slam.cpp -o
// simulate_slam
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <string>

#include "slam_simulator.h"

namespace {

constexpr const char* kUsage = R"(simulate_slam - data for range-only SLAM, with bounded errors

    simulate_slam --out DIR [options]

  --world room|curves|random   the room of the 2011 paper, reconstructed; curved walls; all random
  --name NAME                  NAME.csv, NAME_truth.csv, NAME_map.csv are written (default: the world's name)
  --seed N                     of the noise; for random, of everything (default 1)
  --duration S --dt S          length of the mission and time between rows (default 100 and 0.1)
  --sensor all|cone            the rangefinder sees all around, or a cone around the heading (default all)
  --half-angle RAD             of the cone (default 0.6)
  --max-range M                what is beyond gives no echo, written oo (default: no limit)
  --e-speed V --e-heading V --e-range V   error bounds (default 0.01 each)
  --constant-runs, --uniform   noise with or without runs of constant error at the bound (default: with)
  --jitter                     irregular stamps
  --epoch S                    added to every stamp
  --blank P                    leave the range blank in that share of rows
  --range-file                 ranges go to NAME_range.csv, with stamps of their own
  --range-period S             time between those (default 0.25)
  --dense                      also NAME_truth_dense.csv: ten instants a slice
)";

struct Request {
  slam_simulator::Options options;
  std::string out, name;
  bool cone = false, range_file = false, dense = false;
  double half_angle = 0.6, range_period = 0.25;
};

[[noreturn]] void wrong_usage(const std::string& message) {
  std::cerr << "simulate_slam: " << message << "\n\n" << kUsage;
  std::exit(2);
}

double number(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(v))
    wrong_usage(option + " needs a number, got '" + text + "'");
  return v;
}

Request parse(int argc, char** argv) {
  Request r;
  auto& o = r.options;
  const auto set = [](double& target) {
    return [&target](const std::string& option, const std::string& text) { target = number(option, text); };
  };
  const auto set_text = [](std::string& target) {
    return [&target](const std::string&, const std::string& text) { target = text; };
  };
  using WithValue = std::function<void(const std::string&, const std::string&)>;
  const std::map<std::string, WithValue> with_value = {
      {"--world", set_text(o.world)},
      {"--out", set_text(r.out)},
      {"--name", set_text(r.name)},
      {"--duration", set(o.duration)},
      {"--dt", set(o.dt)},
      {"--half-angle", set(r.half_angle)},
      {"--max-range", set(o.max_range)},
      {"--e-speed", set(o.e_speed)},
      {"--e-heading", set(o.e_heading)},
      {"--e-range", set(o.e_range)},
      {"--epoch", set(o.epoch)},
      {"--blank", set(o.blank)},
      {"--range-period", set(r.range_period)},
      {"--seed",
       [&o](const std::string& option, const std::string& text) {
         const double v = number(option, text);
         if (v < 0 || v > 1e15 || v != std::floor(v)) wrong_usage("--seed needs a whole number");
         o.seed = static_cast<std::uint64_t>(v);
       }},
      {"--sensor",
       [&r](const std::string&, const std::string& text) {
         if (text != "all" && text != "cone") wrong_usage("--sensor is all or cone, got '" + text + "'");
         r.cone = text == "cone";
       }},
  };
  const std::map<std::string, std::function<void()>> flags = {
      {"--constant-runs", [&o] { o.constant_runs = true; }},
      {"--uniform", [&o] { o.constant_runs = false; }},
      {"--jitter", [&o] { o.jitter = true; }},
      {"--range-file", [&r] { r.range_file = true; }},
      {"--dense", [&r] { r.dense = true; }},
      {"--help",
       [] {
         std::cout << kUsage;
         std::exit(0);
       }},
  };
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (const auto flag = flags.find(option); flag != flags.end()) {
      flag->second();
    } else if (const auto known = with_value.find(option); known == with_value.end()) {
      wrong_usage("unknown option '" + option + "'");
    } else if (++i == argc) {
      wrong_usage(option + " needs a value");
    } else {
      known->second(option, argv[i]);
    }
  }
  if (r.out.empty()) wrong_usage("--out DIR is missing");
  if (r.name.empty()) r.name = o.world;
  if (r.cone) o.half_angle = r.half_angle;
  if (r.range_file) o.range_period = r.range_period;
  return r;
}

void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(path);
  write(out);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path.string());
  std::cout << path.string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const Request request = parse(argc, argv);
  try {
    const auto mission = slam_simulator::simulate(request.options);
    const std::filesystem::path dir = request.out;
    std::filesystem::create_directories(dir);
    const auto file = [&](const char* suffix) { return dir / (request.name + suffix + ".csv"); };
    write_file(file(""), [&](std::ostream& out) { slam_simulator::write_log(out, mission); });
    write_file(file("_truth"), [&](std::ostream& out) { slam_simulator::write_truth(out, mission); });
    write_file(file("_map"), [&](std::ostream& out) { slam_simulator::write_map(out, mission); });
    if (request.dense)
      write_file(file("_truth_dense"),
                 [&](std::ostream& out) { slam_simulator::write_truth(out, mission, 10); });
    if (mission.separate_ranges)
      write_file(file("_range"), [&](std::ostream& out) { slam_simulator::write_ranges(out, mission); });
  } catch (const std::exception& error) {
    std::cerr << "simulate_slam: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
