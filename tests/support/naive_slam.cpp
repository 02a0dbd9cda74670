// SPDX-License-Identifier: Apache-2.0
#include "tests/support/naive_slam.h"

#include <algorithm>

#include "domains/rounding.h"

namespace hcsp::naive {

namespace {

// {x in X : x^2 in c}, the two signs apart.
Interval sqr_reverse(const Interval& c, const Interval& x) {
  const Interval root = sqrt(c);
  if (root.is_empty()) return root;
  return join(meet(x, root), meet(x, -root));
}

// s == s1 + s2 backward.
bool add_reverse(const Interval& s, Interval& s1, Interval& s2) {
  s1 = meet(s1, s - s2);
  s2 = meet(s2, s - s1);
  return !s1.is_empty() && !s2.is_empty();
}

// d == a - x backward, on x.
bool difference_reverse(const Interval& d, const Interval& a, Interval& x) {
  x = meet(x, meet(a, d + x) - d);
  return !x.is_empty();
}

// The norm of (d1, w d2) where it is meant to be `length`, forward and backward; w is a weight of the square.
struct Norm {
  Interval d1, d2, weight = 1.0;

  [[nodiscard]] Interval forward() const { return sqrt(sqr(d1) + weight * sqr(d2)); }
  bool backward(const Interval& length) {
    Interval s1 = sqr(d1), s2 = weight * sqr(d2);
    const Interval s = meet(s1 + s2, sqr(length));
    if (s.is_empty() || !add_reverse(s, s1, s2)) return false;
    d1 = sqr_reverse(s1, d1);
    d2 = sqr_reverse(s2 / weight, d2);
    return !d1.is_empty() && !d2.is_empty();
  }
};

// factor * norm == z, the norm that of the cell seen from (x1 + o1, x2 + o2).
bool revise_norm(Sample& s, const Cell& a, const Interval& weight, const Interval& factor, const Interval& o1,
                 const Interval& o2) {
  const Interval q1 = s.x1 + o1, q2 = s.x2 + o2;
  Norm norm{a.a1 - q1, a.a2 - q2, weight};
  const Interval length = norm.forward();
  const Interval z = meet(factor * length, s.z);
  if (z.is_empty() || !norm.backward(meet(length, z / factor))) return false;
  Interval r1 = q1, r2 = q2;
  if (!difference_reverse(norm.d1, a.a1, r1) || !difference_reverse(norm.d2, a.a2, r2)) return false;
  s.z = z;
  s.x1 = meet(s.x1, r1 - o1);
  s.x2 = meet(s.x2, r2 - o2);
  return !s.x1.is_empty() && !s.x2.is_empty();
}

Sensor plain_norm(double weight, double factor) {
  return {[=](const Sample& s, const Cell& a) {
            return (Interval(factor) * Norm{a.a1 - s.x1, a.a2 - s.x2, weight}.forward()).hi() < s.z.lo();
          },
          [=](Sample& s, const Cell& a) { return revise_norm(s, a, weight, factor, 0.0, 0.0); }};
}

// cos(heading) d1 + sin(heading) d2 >= cos(half_angle) |d|, as an interval of the left side less the right.
Interval within_cone(const Sample& s, const Cell& a, const Interval& edge) {
  const Interval d1 = a.a1 - s.x1, d2 = a.a2 - s.x2;
  return s.cosine * d1 + s.sine * d2 - edge * Norm{d1, d2}.forward();
}

// R(heading) (ahead, left).
std::pair<Interval, Interval> turned(const Sample& s, double ahead, double left) {
  return {s.cosine * ahead - s.sine * left, s.sine * ahead + s.cosine * left};
}

struct Solver {
  const Log& log;
  const Sensor& sensor;
  Solution solution;
  std::vector<double> lines;                  // of the cells of an axis, one more than cells
  std::vector<std::vector<Interval>> slopes;  // by component and slice

  // The cells [i h, (i + 1) h) that the closed frame touches.
  void make_grid(double h, double reach) {
    auto i = static_cast<std::int64_t>(-reach / h) - 2;
    while (static_cast<double>(i + 1) * h <= -reach) ++i;
    solution.cell_edge = h;
    solution.first = i;
    for (; static_cast<double>(i) * h <= reach; ++i) lines.push_back(static_cast<double>(i) * h);
    lines.push_back(static_cast<double>(i) * h);
    solution.count = static_cast<std::int64_t>(lines.size()) - 1;
    solution.dug.assign((lines.size() - 1) * (lines.size() - 1), 0);
  }

  void make_tubes() {
    slopes.resize(2);
    for (std::size_t k = 0; k < log.stamps.size(); ++k) {
      const bool last = k + 1 == log.stamps.size();
      const Interval cosine = cos(log.heading[k]), sine = sin(log.heading[k]);
      if (!last) slopes[0].push_back(log.speed[k] * cosine);
      if (!last) slopes[1].push_back(log.speed[k] * sine);
      const Interval where = k == 0 ? Interval(0.0) : Interval::entire();
      solution.gates.push_back({where, where, cosine, sine, log.range[k].value_or(Interval::entire())});
    }
  }

  [[nodiscard]] Interval duration(std::size_t k) const {
    return Interval(log.stamps[k + 1]) - Interval(log.stamps[k]);
  }

  bool narrow(Interval& x, const Interval& bound) {
    const Interval met = meet(x, bound);
    const bool changed = !(met == x);
    x = met;
    if (x.is_empty()) solution.feasible = false;
    return changed;
  }

  // x(t[k + 1]) - x(t[k]) is in slope dt, forward and backward.
  bool dead_reckoning() {
    bool changed = false;
    for (int c = 0; c < 2; ++c) {
      const auto x = [&](std::size_t k) -> Interval& {
        return c == 0 ? solution.gates[k].x1 : solution.gates[k].x2;
      };
      const auto& slope = slopes[static_cast<std::size_t>(c)];
      for (std::size_t k = 0; k < slope.size(); ++k) {
        changed = narrow(x(k + 1), x(k) + slope[k] * duration(k)) || changed;
      }
      for (std::size_t k = slope.size(); k-- > 0;) {
        changed = narrow(x(k), x(k + 1) - slope[k] * duration(k)) || changed;
      }
    }
    return changed;
  }

  // Calls visit(cell, its bit) for every cell.
  template <class Visit>
  void for_each_cell(Visit visit) {
    std::size_t at = 0;
    for (std::size_t i2 = 0; i2 + 1 < lines.size(); ++i2) {
      for (std::size_t i1 = 0; i1 + 1 < lines.size(); ++i1, ++at) {
        visit(Cell{Interval(lines[i1], lines[i1 + 1]), Interval(lines[i2], lines[i2 + 1])}, solution.dug[at]);
      }
    }
  }

  bool dig() {
    bool changed = false;
    for (std::size_t k = 0; k < log.stamps.size(); ++k) {
      if (!log.range[k]) continue;
      for_each_cell([&](const Cell& cell, std::uint8_t& dug) {
        if (dug != 0 || !sensor.digs(solution.gates[k], cell)) return;
        dug = 1;
        changed = true;
      });
    }
    return changed;
  }

  // Every sample with a range keeps the hull of what the cells that are not dug support.
  bool impact() {
    bool changed = false;
    for (std::size_t k = 0; k < log.stamps.size() && solution.feasible; ++k) {
      if (!log.range[k]) continue;
      Sample& sample = solution.gates[k];
      Sample hull{Interval::empty(), Interval::empty(), sample.cosine, sample.sine, Interval::empty()};
      for_each_cell([&](const Cell& cell, std::uint8_t& dug) {
        Sample part = sample;
        if (dug != 0 || !sensor.revise(part, cell)) return;
        hull.x1 = join(hull.x1, part.x1);
        hull.x2 = join(hull.x2, part.x2);
        hull.z = join(hull.z, part.z);
      });
      changed = narrow(sample.x1, hull.x1) || changed;
      changed = narrow(sample.x2, hull.x2) || changed;
      changed = narrow(sample.z, hull.z) || changed;
    }
    return changed;
  }

  void fill_slices() {
    solution.slices.resize(2);
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t k = 0; k < slopes[c].size(); ++k) {
        const Interval& x0 = c == 0 ? solution.gates[k].x1 : solution.gates[k].x2;
        const Interval& x1 = c == 0 ? solution.gates[k + 1].x1 : solution.gates[k + 1].x2;
        const double hi = slice_upper(x0.hi(), x1.hi(), slopes[c][k], duration(k));
        const double lo = -slice_upper(-x0.lo(), -x1.lo(), -slopes[c][k], duration(k));
        solution.slices[c].push_back(Interval(lo, hi));
      }
    }
  }
};

}  // namespace

Sensor euclidean() { return plain_norm(1.0, 1.0); }
Sensor doubled() { return plain_norm(1.0, 2.0); }
Sensor elliptic() { return plain_norm(4.0, 1.0); }

Sensor off_centre(double ahead, double left) {
  return {[=](const Sample& s, const Cell& a) {
            const auto [o1, o2] = turned(s, ahead, left);
            return Norm{a.a1 - s.x1 - o1, a.a2 - s.x2 - o2}.forward().hi() < s.z.lo();
          },
          [=](Sample& s, const Cell& a) {
            const auto [o1, o2] = turned(s, ahead, left);
            return revise_norm(s, a, 1.0, 1.0, o1, o2);
          }};
}

Sensor cone(double half_angle) {
  const Interval edge = cos(Interval(half_angle));
  return {
      [=](const Sample& s, const Cell& a) {
        return within_cone(s, a, edge).lo() >= 0 && Norm{a.a1 - s.x1, a.a2 - s.x2}.forward().hi() < s.z.lo();
      },
      [=](Sample& s, const Cell& a) {
        return within_cone(s, a, edge).hi() >= 0 && revise_norm(s, a, 1.0, 1.0, 0.0, 0.0);
      }};
}

// The maximum over the slice of the lesser of the lines x0 + v.hi s and x1 - v.lo (dt - s): at an end or
// where they cross.
double slice_upper(double x0, double x1, const Interval& v, const Interval& dt) {
  const Interval start(x0), end(x1), rise(v.hi()), fall(v.lo());
  const double at_start = std::min(x0, (end - fall * dt).hi());
  const double at_end = std::min(x1, (start + rise * dt).hi());
  double highest = std::max(at_start, at_end);
  const Interval crossing = meet((end - fall * dt - start) / (rise - fall), Interval(0.0, dt.hi()));
  if (!crossing.is_empty()) {
    const double at_crossing = std::min((start + rise * crossing).hi(), (end - fall * (dt - crossing)).hi());
    highest = std::max(highest, at_crossing);
  }
  return highest;
}

Solution solve(const Log& log, const Sensor& sensor, double cell_edge, double reach) {
  Solver solver{log, sensor, {}, {}, {}};
  solver.make_grid(cell_edge, reach);
  solver.make_tubes();
  RoundUpward guard;  // a matter of speed: the operations of Interval need not set it
  for (bool changed = true; changed && solver.solution.feasible;) {
    ++solver.solution.passes;
    changed = solver.dead_reckoning();
    if (!solver.solution.feasible) break;
    changed = solver.dig() || changed;
    changed = solver.impact() || changed;
  }
  if (solver.solution.feasible) solver.fill_slices();
  return solver.solution;
}

double Solution::mean_width() const {
  double sum = 0;
  for (std::size_t k = 0; k < slices[0].size(); ++k)
    sum += std::max(slices[0][k].width(), slices[1][k].width());
  return sum / static_cast<double>(slices[0].size());
}

double Solution::dug_area() const {
  return static_cast<double>(std::count(dug.begin(), dug.end(), 1)) * cell_edge * cell_edge;
}

double Solution::map_area() const {
  return static_cast<double>(std::count(dug.begin(), dug.end(), 0)) * cell_edge * cell_edge;
}

bool Solution::is_dug(std::int64_t i1, std::int64_t i2) const {
  if (i1 < first || i2 < first || i1 >= first + count || i2 >= first + count) return false;
  return dug[static_cast<std::size_t>((i2 - first) * count + i1 - first)] != 0;
}

}  // namespace hcsp::naive
