// SPDX-License-Identifier: Apache-2.0
// The worlds of the simulator: walls, the distance to them, and the curves along which the robot drives.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace slam_simulator {

/// A decimal number with six digits after the point, as the count of its millionths.
using Micro = std::int64_t;

struct Point {
  double x1 = 0, x2 = 0;
};

/// A wall, from a to b. A curved wall is a fine polyline: the polyline is the true map.
struct Segment {
  Point a, b;
};
using Map = std::vector<Segment>;

// --- numbers
// -----------------------------------------------------------------------------------------------------

/// The double nearest to the decimal.
inline double value(Micro m) { return static_cast<double>(m) / 1e6; }

inline Micro micro(double v) { return std::llround(v * 1e6); }

/// The decimal in its shortest form: 0.3, -2, 12.034.
inline std::string decimal(Micro m) {
  const std::uint64_t magnitude = m < 0 ? 0 - static_cast<std::uint64_t>(m) : static_cast<std::uint64_t>(m);
  std::string text = m < 0 ? "-" : "";
  text += std::to_string(magnitude / 1000000);
  std::string digits = std::to_string(1000000 + magnitude % 1000000).substr(1);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (!digits.empty()) text.append(1, '.').append(digits);
  return text;
}

/// The shortest decimal that reads back as the same double.
inline std::string shortest(double v) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, v).ptr;
  return {buffer, end};
}

/// Uniform draws, the same on every machine (the standard fixes the engine, not its distributions).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int integer(int lo, int hi) { return std::min(hi, lo + static_cast<int>(in(0, hi - lo + 1))); }
  bool chance(double probability) { return in(0, 1) < probability; }

 private:
  std::mt19937_64 engine_;
};

// --- the rangefinder
// ---------------------------------------------------------------------------------------------

/// The distance from p to the part s in [from, to] of the wall a + s (b - a).
inline double distance(Point p, const Segment& wall, double from = 0, double to = 1) {
  const double d1 = wall.b.x1 - wall.a.x1, d2 = wall.b.x2 - wall.a.x2;
  const double r1 = p.x1 - wall.a.x1, r2 = p.x2 - wall.a.x2;
  const double length2 = d1 * d1 + d2 * d2;
  const double s = length2 > 0 ? std::clamp((r1 * d1 + r2 * d2) / length2, from, to) : from;
  return std::hypot(r1 - s * d1, r2 - s * d2);
}

/// The distance from p to the nearest point of the map; infinite when there is none.
inline double distance(Point p, const Map& map) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : map) nearest = std::min(nearest, distance(p, wall));
  return nearest;
}

/// The distance from p to the nearest point of the map within half_angle (below pi/2) of the heading.
inline double distance_in_cone(Point p, double heading, double half_angle, const Map& map) {
  double nearest = std::numeric_limits<double>::infinity();
  const double edges[2] = {heading - half_angle, heading + half_angle};
  for (const Segment& wall : map) {
    double from = 0, to = 1;  // the part of the wall on the inner side of both edges
    for (int e = 0; e < 2; ++e) {
      const double n1 = (e == 0 ? -1 : 1) * std::sin(edges[e]), n2 = (e == 0 ? 1 : -1) * std::cos(edges[e]);
      const double at_a = n1 * (wall.a.x1 - p.x1) + n2 * (wall.a.x2 - p.x2);
      const double at_b = n1 * (wall.b.x1 - p.x1) + n2 * (wall.b.x2 - p.x2);
      if (at_a < 0 && at_b < 0) to = -1;
      if (at_a < 0 && at_b >= 0) from = std::max(from, at_a / (at_a - at_b));
      if (at_a >= 0 && at_b < 0) to = std::min(to, at_a / (at_a - at_b));
    }
    if (from <= to) nearest = std::min(nearest, distance(p, wall, from, to));
  }
  return nearest;
}

// --- worlds
// ------------------------------------------------------------------------------------------------------

/// Joins the points by walls, on whole millionths so that the written map is the map; closed back to the
/// first.
inline void add_polyline(Map& map, std::vector<Point> points, bool closed) {
  for (Point& p : points) p = {value(micro(p.x1)), value(micro(p.x2))};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) map.push_back({points[i], points[i + 1]});
  if (closed && points.size() > 2) map.push_back({points.back(), points.front()});
}

/// An arc of an ellipse, as a polyline of n walls.
inline void add_arc(Map& map, Point centre, double r1, double r2, double from, double to, int n) {
  std::vector<Point> points;
  for (int i = 0; i <= n; ++i) {
    const double angle = from + (to - from) * i / n;
    points.push_back({centre.x1 + r1 * std::cos(angle), centre.x2 + r2 * std::sin(angle)});
  }
  add_polyline(map, points, false);
}

/// A reconstruction of the room of Jaulin, IEEE T-RO 27(5), 2011, Fig. 7, whose coordinates were never
/// published: walls in [-10, 10]^2, a right and a left part with a passage between them around the start.
inline Map room_map() {
  Map map;
  add_polyline(map,
               {{-9.2, -8.4},
                {-3.1, -9.2},
                {-1.2, -8.8},
                {1.2, -8.3},
                {8.8, -8.9},
                {9.3, -2.3},
                {8.7, 2.2},
                {9.4, 6.2},
                {6.7, 9.1},
                {0.6, 8.4},
                {-4.6, 9.2},
                {-9.0, 7.3},
                {-9.4, 0.7}},
               true);
  add_polyline(map, {{0.6, 8.4}, {-0.2, 4.6}}, false);
  add_polyline(map, {{1.2, -8.3}, {0.3, -4.2}}, false);
  add_polyline(map, {{8.7, 2.2}, {7.5, 2.7}}, false);
  add_polyline(map, {{-9.4, 0.7}, {-8.3, 0.9}}, false);
  add_polyline(map, {{-1.2, -8.8}, {-1.6, -7.6}}, false);
  add_polyline(map, {{3.7, 0.1}, {4.6, 0.2}, {4.2, 0.9}}, true);
  add_polyline(map, {{-5.2, -0.9}, {-4.3, -0.4}, {-4.9, 0.3}}, true);
  return map;
}

/// Where the robot of the room drives: round the right part, then the left, back to the right, and so on.
inline std::vector<Point> room_path() {
  return {{0, 0},       {2.3, -1.0},  {4.4, -1.4},  {5.9, -0.2},  {5.8, 2.4},  {5.8, 4.9},  {3.6, 5.6},
          {2.4, 3.6},   {2.4, 1.2},   {2.8, -1.6},  {3.6, -4.8},  {5.9, -5.4}, {6.2, -3.0}, {5.8, 0.2},
          {4.2, 2.2},   {1.6, 1.6},   {-1.0, 1.8},  {-2.6, 4.6},  {-5.4, 5.4}, {-6.8, 2.8}, {-6.6, -1.2},
          {-6.2, -4.4}, {-3.6, -5.4}, {-2.4, -3.0}, {-1.2, -1.0}, {1.2, -0.9}, {3.4, -2.4}, {5.8, -3.4},
          {6.6, -0.8},  {5.4, 1.4},   {3.4, 2.0},   {1.8, 3.8},   {3.2, 6.2},  {6.2, 5.6},  {6.4, 3.0},
          {4.8, 1.9},   {2.6, 1.4}};
}

/// A world whose walls are curves.
inline Map curves_map() {
  Map map;
  std::vector<Point> shore;
  for (int i = 0; i < 720; ++i) {
    const double angle = 2 * std::numbers::pi * i / 720;
    const double radius = 8.4 + 0.7 * std::cos(3 * angle + 0.4) + 0.4 * std::sin(5 * angle);
    shore.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  add_polyline(map, shore, true);
  constexpr double kPi = std::numbers::pi;
  add_arc(map, {4.2, 2.0}, 0.8, 0.8, 0, 2 * kPi, 120);
  add_arc(map, {4.2, -3.4}, 1.3, 0.7, 0, 2 * kPi, 120);
  add_arc(map, {-4.4, -2.4}, 1.1, 1.1, 0, 2 * kPi, 120);
  add_arc(map, {-3.4, 3.4}, 1.5, 1.2, 0.2 * kPi, 1.3 * kPi, 120);
  add_arc(map, {0.2, 7.2}, 0.5, 3.0, kPi, 2 * kPi, 120);
  return map;
}

inline std::vector<Point> curves_path() {
  return {{0, 0},       {2.0, 0.0},   {4.4, -0.4},  {6.6, 0.4},  {6.4, 2.5},  {4.6, 4.2},  {2.5, 3.9},
          {1.8, 1.6},   {2.0, -1.6},  {2.0, -4.4},  {4.2, -5.6}, {6.4, -4.4}, {6.2, -1.6}, {3.6, 0.6},
          {0.6, 1.6},   {-1.4, 3.4},  {-2.0, 5.8},  {-4.6, 6.2}, {-6.4, 4.2}, {-5.8, 1.2}, {-6.6, -1.6},
          {-6.2, -4.4}, {-3.6, -5.2}, {-1.6, -4.2}, {-1.8, -1.6}};
}

/// Random walls: a ragged outer wall, perhaps with gaps, and a few others, all at least 1 m from the start.
inline Map random_map(Random& random) {
  Map walls, map;
  std::vector<Point> corners;
  const int n = random.integer(5, 12);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.in(-0.3, 0.3)) / n, radius = random.in(5, 9.9);
    corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  add_polyline(walls, corners, true);
  for (int i = random.integer(2, 9); i > 0; --i) {
    const Point p = {random.in(-8, 8), random.in(-8, 8)};
    const double angle = random.in(0, 2 * std::numbers::pi), length = random.in(0.3, 3);
    add_polyline(walls,
                 {p,
                  {std::clamp(p.x1 + length * std::cos(angle), -9.9, 9.9),
                   std::clamp(p.x2 + length * std::sin(angle), -9.9, 9.9)}},
                 false);
  }
  const double gaps = random.chance(0.5) ? 0.0 : random.in(0, 0.3);
  for (const Segment& wall : walls)
    if (distance({0, 0}, wall) >= 1 && !random.chance(gaps)) map.push_back(wall);
  if (map.empty()) map.push_back({{3, -2}, {3, 2}});
  return map;
}

}  // namespace slam_simulator
