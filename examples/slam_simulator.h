// SPDX-License-Identifier: Apache-2.0
// Makes data for range-only SLAM: a world of wall segments, a robot that drives in it, and what its sensors
// report with bounded errors. The bounds hold for the decimals that are written, not only for the doubles
// behind them: every written number is a whole count of millionths, and errors stop one millionth short of
// their bound. Standard library only; a seed gives the same data wherever sin and cos agree.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "slam_worlds.h"

namespace slam_simulator {

struct Options {
  std::string world = "room";  // room, curves or random
  std::uint64_t seed = 1;      // of the noise; of the whole world and the path when the world is random
  double duration = 100;       // s
  double dt = 0.1;             // s, between two rows
  double e_speed = 0.01;       // bounds of the errors: m/s, rad, m
  double e_heading = 0.01;
  double e_range = 0.01;
  bool constant_runs = true;         // the noise includes runs of constant error, just within the bound
  std::optional<double> half_angle;  // rad; the rangefinder sees a cone around the heading, else all around
  double max_range = std::numeric_limits<double>::infinity();  // m; what is beyond gives no echo
  bool jitter = false;                                         // irregular stamps
  double epoch = 0;                                            // s, added to every stamp
  double blank = 0;                                            // the share of range readings that are missing
  std::optional<double> range_period;  // s; the ranges have stamps of their own, about so far apart
};

/// A range reading: a number, or nothing was measured, or nothing was in sight.
struct Reading {
  enum class Kind { value, blank, no_echo };
  Micro t = 0;
  Kind kind = Kind::value;
  Micro range = 0;
};

/// The true motion: speed and heading hold from one stamp to the next.
struct Trajectory {
  std::vector<double> t;      // the doubles nearest to the written stamps
  std::vector<Point> x;       // where the robot is at t[k]
  std::vector<double> speed;  // over [t[k], t[k+1]); the last entry repeats the one before
  std::vector<double> heading;

  /// Where the robot is at any time of the mission.
  [[nodiscard]] Point at(double time) const {
    const std::size_t k = row(time);
    const long double dt = static_cast<long double>(time) - t[k];
    return {static_cast<double>(x[k].x1 + speed[k] * std::cos(static_cast<long double>(heading[k])) * dt),
            static_cast<double>(x[k].x2 + speed[k] * std::sin(static_cast<long double>(heading[k])) * dt)};
  }
  /// The row that holds at a time of the mission.
  [[nodiscard]] std::size_t row(double time) const {
    const auto after = std::upper_bound(t.begin(), t.end(), time);
    return after == t.begin() ? 0 : static_cast<std::size_t>(after - t.begin()) - 1;
  }
};

/// All that one run makes. Row k of the log is stamps[k], speed[k], heading[k] and, unless the ranges have
/// stamps of their own, readings[k].
struct Mission {
  Map map;
  Trajectory truth;
  std::vector<Micro> stamps, speed, heading;
  std::vector<Reading> readings;
  bool separate_ranges = false;
};

// --- measurements -----------------------------------------------------------------------------------------

/// Errors of one sensor channel: uniform ones and, where asked, runs of constant error just within the bound.
class Noise {
 public:
  Noise(double bound, bool constant_runs, std::uint64_t seed)
      : amplitude_(bound - 1e-6), constant_runs_(constant_runs), random_(seed) {
    if (!(bound >= 1e-5)) throw std::invalid_argument("an error bound must be at least 0.00001");
  }
  /// The decimal that is written for a true value: within the bound of it.
  Micro measure(double truth) { return micro(truth + next()); }

 private:
  double next() {
    if (left_ == 0) {
      left_ = random_.integer(5, 40);
      constant_ = constant_runs_ && random_.chance(0.5);
      error_ = random_.chance(0.5) ? amplitude_ : -amplitude_;
    }
    --left_;
    return constant_ ? error_ : random_.in(-amplitude_, amplitude_);
  }
  double amplitude_;
  bool constant_runs_;
  Random random_;
  int left_ = 0;
  bool constant_ = false;
  double error_ = 0;
};

// --- motion
// ------------------------------------------------------------------------------------------------------

/// Adds the next stamp: the robot holds speed and heading from the last one.
inline void advance(Trajectory& path, double t_next, double speed, double heading) {
  path.speed.back() = speed;
  path.heading.back() = heading;
  const Point x = path.at(t_next);
  path.t.push_back(t_next);
  path.x.push_back(x);
  path.speed.push_back(speed);
  path.heading.push_back(heading);
}

inline Trajectory standing_at_start(double t0) { return {{t0}, {{0, 0}}, {0}, {0}}; }

/// A closed Catmull-Rom spline through the way points, as a fine polyline.
inline std::vector<Point> closed_spline(const std::vector<Point>& way) {
  constexpr int kSteps = 400;
  std::vector<Point> fine;
  const std::size_t n = way.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point p = way[(i + n - 1) % n], q = way[i], r = way[(i + 1) % n], s = way[(i + 2) % n];
    for (int k = 0; k < kSteps; ++k) {
      const double u = static_cast<double>(k) / kSteps;
      const auto blend = [u](double a, double b, double c, double d) {
        return b + 0.5 * u * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a)));
      };
      fine.push_back({blend(p.x1, q.x1, r.x1, s.x1), blend(p.x2, q.x2, r.x2, s.x2)});
    }
  }
  return fine;
}

/// Follows the closed curve through the way points, lap after lap, at about 1 m/s.
inline Trajectory follow(const std::vector<Point>& way, const std::vector<Micro>& stamps) {
  const std::vector<Point> curve = closed_spline(way);
  Trajectory path = standing_at_start(value(stamps.front()));
  std::size_t i = 0;
  double along = 0, heading = 0;  // how far past curve[i] the robot should be
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    const double t = path.t.back(), dt = value(stamps[k]) - t, since = t - path.t.front();
    along += dt * (1 + 0.1 * std::sin(0.37 * since) + 0.05 * std::sin(1.1 * since));
    const auto piece = [&] {
      return std::hypot(curve[(i + 1) % curve.size()].x1 - curve[i].x1,
                        curve[(i + 1) % curve.size()].x2 - curve[i].x2);
    };
    while (along > piece()) {
      along -= piece();
      i = (i + 1) % curve.size();
    }
    const Point a = curve[i], b = curve[(i + 1) % curve.size()], x = path.x.back();
    const double u = along / piece();
    const double d1 = a.x1 + u * (b.x1 - a.x1) - x.x1, d2 = a.x2 + u * (b.x2 - a.x2) - x.x2;
    heading += std::remainder(std::atan2(d2, d1) - heading, 2 * std::numbers::pi);  // without jumps of 2 pi
    advance(path, value(stamps[k]), std::hypot(d1, d2) / dt, heading);
  }
  return path;
}

/// Wanders at random, clear of the walls and of the frame [-10, 10]^2.
inline Trajectory wander(const Map& map, const std::vector<Micro>& stamps, Random& random) {
  const auto clearance = [&map](Point p) {
    return std::min({distance(p, map), 9.9 - std::abs(p.x1), 9.9 - std::abs(p.x2)});
  };
  Trajectory path = standing_at_start(value(stamps.front()));
  double heading = random.in(-std::numbers::pi, std::numbers::pi), wish = 0, until = path.t.front();
  const double cruise = random.in(0.4, 1.5);
  // The least clearance over the next two seconds with a rate of turn.
  const auto look_ahead = [&](double rate) {
    Point p = path.x.back();
    double least = std::numeric_limits<double>::infinity(), angle = heading;
    for (int i = 0; i < 10; ++i) {
      angle += 0.2 * rate;
      p = {p.x1 + 0.2 * cruise * std::cos(angle), p.x2 + 0.2 * cruise * std::sin(angle)};
      least = std::min(least, clearance(p));
    }
    return least;
  };
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    const double t = path.t.back(), dt = value(stamps[k]) - t;
    if (t >= until) {
      wish = random.in(-1, 1);
      until = t + random.in(1, 5);
    }
    double rate = wish, best = look_ahead(wish);
    for (const double other : {-0.5, 0.5, -1.2, 1.2, -2.4, 2.4}) {
      if (best >= 0.4) break;
      if (const double room = look_ahead(other); room > best) rate = other, best = room;
    }
    heading += rate * dt;
    double speed = cruise;  // a step shorter than the room it has cannot touch a wall
    speed = std::min(speed, std::max(0.0, clearance(path.x.back()) - 0.2) / dt);
    advance(path, value(stamps[k]), speed, heading);
  }
  return path;
}

// --- the mission
// -------------------------------------------------------------------------------------------------

/// Stamps a period apart, from epoch to epoch + duration; with jitter all but the ends move by up to 0.4 of
/// it.
inline std::vector<Micro> make_stamps(double period, const Options& options, Random& random) {
  if (!(period >= 1e-5) || !(options.duration >= period) || options.duration > 1e8)
    throw std::invalid_argument(
        "the mission needs a period of at least 0.00001 s and a duration of at least one period");
  const Micro start = micro(options.epoch), step = micro(period);
  const std::int64_t n = micro(options.duration) / step;
  std::vector<Micro> stamps;
  for (std::int64_t k = 0; k <= n; ++k) {
    const double shift = options.jitter && k > 0 && k < n ? random.in(-0.4, 0.4) : 0.0;
    stamps.push_back(start + k * step + std::llround(shift * static_cast<double>(step)));
  }
  return stamps;
}

/// Exactly the share of the readings that is asked for becomes blank, at random places.
inline void blank_out(std::vector<Reading>& readings, double share, Random& random) {
  if (!(share >= 0 && share <= 1)) throw std::invalid_argument("the share of blank ranges must be in [0, 1]");
  const auto n = static_cast<double>(readings.size());
  double left = n, wanted = std::floor(share * n + 0.5);
  for (Reading& reading : readings) {
    if (random.in(0, left) < wanted) {
      reading.kind = Reading::Kind::blank;
      --wanted;
    }
    --left;
  }
}

inline Mission simulate(const Options& options) {
  if (options.half_angle && !(*options.half_angle > 0 && *options.half_angle < std::numbers::pi / 2))
    throw std::invalid_argument("the half-angle of the cone must be between 0 and pi/2");
  Random world(options.seed * 4 + 1), stamping(options.seed * 4 + 2), blanking(options.seed * 4 + 3);
  Mission mission;
  mission.stamps = make_stamps(options.dt, options, stamping);
  if (options.world == "room") {
    mission.map = room_map();
    mission.truth = follow(room_path(), mission.stamps);
  } else if (options.world == "curves") {
    mission.map = curves_map();
    mission.truth = follow(curves_path(), mission.stamps);
  } else if (options.world == "random") {
    mission.map = random_map(world);
    mission.truth = wander(mission.map, mission.stamps, world);
  } else {
    throw std::invalid_argument("unknown world '" + options.world + "': expected room, curves or random");
  }

  const std::uint64_t seed = options.seed * 3;
  Noise speed_noise(options.e_speed, options.constant_runs, seed);
  Noise heading_noise(options.e_heading, options.constant_runs, seed + 1);
  Noise range_noise(options.e_range, options.constant_runs, seed + 2);
  for (const double speed : mission.truth.speed) mission.speed.push_back(speed_noise.measure(speed));
  for (const double heading : mission.truth.heading)
    mission.heading.push_back(heading_noise.measure(heading));

  mission.separate_ranges = options.range_period.has_value();
  for (const Micro t :
       mission.separate_ranges ? make_stamps(*options.range_period, options, stamping) : mission.stamps) {
    const Point x = mission.truth.at(value(t));
    const double heading = mission.truth.heading[mission.truth.row(value(t))];
    const double range = options.half_angle ? distance_in_cone(x, heading, *options.half_angle, mission.map)
                                            : distance(x, mission.map);
    Reading reading{t, Reading::Kind::no_echo, 0};
    if (range <= options.max_range && range < 1e6)
      reading = {t, Reading::Kind::value, range_noise.measure(range)};
    mission.readings.push_back(reading);
  }
  blank_out(mission.readings, options.blank, blanking);
  return mission;
}

// --- files
// -------------------------------------------------------------------------------------------------------

inline std::string cell(const Reading& reading) {
  if (reading.kind == Reading::Kind::blank) return "";
  return reading.kind == Reading::Kind::no_echo ? "oo" : decimal(reading.range);
}

/// t,speed,heading,range; without range where the ranges have a file of their own.
inline void write_log(std::ostream& out, const Mission& mission) {
  out << (mission.separate_ranges ? "t,speed,heading\n" : "t,speed,heading,range\n");
  for (std::size_t k = 0; k < mission.stamps.size(); ++k) {
    out << decimal(mission.stamps[k]) << ',' << decimal(mission.speed[k]) << ','
        << decimal(mission.heading[k]);
    if (!mission.separate_ranges) out << ',' << cell(mission.readings[k]);
    out << '\n';
  }
}

inline void write_ranges(std::ostream& out, const Mission& mission) {
  out << "t,range\n";
  for (const Reading& reading : mission.readings) out << decimal(reading.t) << ',' << cell(reading) << '\n';
}

/// Where the robot was, at each stamp of the log and at per_slice - 1 instants between two of them.
inline void write_truth(std::ostream& out, const Mission& mission, int per_slice = 1) {
  out << "t,x1,x2\n";
  const auto row = [&](Micro t) {
    const Point x = mission.truth.at(value(t));
    out << decimal(t) << ',' << shortest(x.x1) << ',' << shortest(x.x2) << '\n';
  };
  for (std::size_t k = 0; k + 1 < mission.stamps.size(); ++k)
    for (int i = 0; i < per_slice; ++i)
      row(mission.stamps[k] + (mission.stamps[k + 1] - mission.stamps[k]) * i / per_slice);
  row(mission.stamps.back());
}

inline void write_map(std::ostream& out, const Mission& mission) {
  out << "x1a,x2a,x1b,x2b\n";
  for (const Segment& wall : mission.map)
    out << decimal(micro(wall.a.x1)) << ',' << decimal(micro(wall.a.x2)) << ',' << decimal(micro(wall.b.x1))
        << ',' << decimal(micro(wall.b.x2)) << '\n';
}

}  // namespace slam_simulator
