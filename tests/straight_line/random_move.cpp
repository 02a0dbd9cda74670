// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/random_move.h"

#include <algorithm>

#include "tests/straight_line/snap.h"

namespace hcsp::straight_line {

namespace {

double rounded(double x) { return std::max(0.25, std::round(4 * x) / 4); }

/// In other units of length and time, or with velocities that are small for the jerk.
void scale_limits(Draw& draw, Kind kind, Move& move) {
  const double length = kind == Kind::scaled ? draw.magnitude(1e-6, 1e6) : 1,
               time = kind == Kind::scaled ? draw.magnitude(1e-3, 1e3) : 1,
               range = kind == Kind::overshooting ? draw.magnitude(1e-3, 0.3) : 1;
  double unit = length;
  for (const auto& both : {std::pair{&move.vmin, &move.vmax},
                           {&move.amin, &move.amax},
                           {&move.jmin, &move.jmax},
                           {&move.dmax, &move.dmax}}) {
    unit /= time;
    const double by = both.first == &move.vmin ? unit * range : unit;
    for (double& x : *both.second) x *= by;
    if (both.first != both.second) {
      for (double& x : *both.first) x *= by;
    }
  }
}

void draw_limits(Draw& draw, Kind kind, Move& move, std::size_t joints) {
  const bool directed = kind == Kind::near_limits || draw.chance(0.3);
  const auto draw_pair = [&](Vector& least, Vector& greatest, double low, double high) {
    for (std::size_t k = 0; k < joints; ++k) {
      double up = draw.magnitude(low, high), down = directed ? up * draw.magnitude(0.3, 2) : up;
      if (kind == Kind::round) {
        up = draw.chance(0.5) ? std::exp2(std::round(std::log2(up))) : rounded(up);
        down = draw.chance(0.7) ? up : rounded(down);
      }
      greatest.push_back(up);
      least.push_back(-down);
    }
  };
  draw_pair(move.vmin, move.vmax, 0.3, 3);
  draw_pair(move.amin, move.amax, 0.5, 10);
  draw_pair(move.jmin, move.jmax, 2, 100);
  Vector same;
  draw_pair(same, move.dmax, 20, 2000);
  scale_limits(draw, kind, move);
}

/// Joints that go along with a direction of the line may not go back.
void forbid_one_way(Draw& draw, Move& move, const std::vector<Number>& rho) {
  const double direction = draw.sign();
  for (std::size_t k = 0; k < rho.size(); ++k) {
    if (draw.chance(0.5)) (rho[k] * direction > 0 ? move.vmin : move.vmax)[k] = 0;
  }
}

std::vector<Number> draw_line(Draw& draw, Kind kind, std::size_t joints) {
  std::vector<Number> rho;
  for (std::size_t k = 0; k < joints; ++k) {
    double ratio = draw.sign() * draw.magnitude(0.01, 1);
    if (kind == Kind::round) ratio = draw.sign() * std::exp2(-draw.integer(0, 3));
    if (kind == Kind::still && draw.chance(0.6)) ratio = 0;
    rho.emplace_back(ratio);
  }
  rho[static_cast<std::size_t>(draw.integer(0, static_cast<int>(joints) - 1))] = draw.sign();
  return rho;
}

double number(const Number& x) { return x.convert_to<double>(); }

/// Between two limits, now and then one of them or nothing.
double within(Draw& draw, Kind kind, const Number& low, const Number& high) {
  if (kind == Kind::round)
    return std::clamp(std::round(draw.in(number(low), number(high)) * 4) / 4, number(low), number(high));
  if (draw.chance(0.1)) return 0;
  if (kind == Kind::near_limits && draw.chance(0.5)) {
    const double inside = draw.chance(0.2) ? 0 : draw.magnitude(1e-12, 0.1);
    return draw.chance(0.5) ? number(high) * (1 - inside) : number(low) * (1 - inside);
  }
  return draw.in(number(low), number(high));
}

bool has(int type, const std::string& name) {
  const std::vector<std::string> names = vectors_of(type);
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// As well with snap limited: a jerk too.
void draw_end_with_snap(Draw& draw, Kind kind, const Move& move, Line& line, bool is_target) {
  const Limits l = limits_on(line.rho, move);
  const Number snap = snap_on(line.rho, move);
  const bool with_w = !is_target || has(move.type, "v1"), with_b = !is_target || has(move.type, "a1");
  const bool with_u = !is_target || has(move.type, "j1");
  for (int tries = 0;; ++tries) {
    State s;
    const double less = tries < 20 ? 1 : 0.5;
    if (with_w) s.w = within(draw, kind, l.wl, l.wh) * less;
    if (with_b) s.b = within(draw, kind, l.bl, l.bh) * less;
    const Number u = with_u && draw.chance(0.5) ? within(draw, kind, l.ul, l.uh) * less : 0;
    if (!(is_target ? can_have_started_with_snap : can_stop_with_snap)(s, u, l, snap)) continue;
    (is_target ? line.to : line.from) = s;
    (is_target ? line.to_jerk : line.from_jerk) = u;
    return;
  }
}

/// A velocity and an acceleration that a type has, admissible (backward in time for a target).
State draw_end(Draw& draw, Kind kind, const Limits& l, bool with_w, bool with_b, bool is_target) {
  for (;;) {
    State s;
    if (with_w) s.w = within(draw, kind, l.wl, l.wh);
    if (with_b) s.b = within(draw, kind, l.bl, l.bh);
    if (is_target ? can_have_started(s, l) : can_stop(s, l)) return s;
  }
}

State draw_beyond(Draw& draw, const Limits& l, bool with_b) {
  for (;;) {
    const State s{0, number(l.wh) * draw.in(-2, 2), with_b ? number(l.bh) * draw.in(-2, 2) : 0};
    if (!(with_b ? can_stop(s, l) : s.w >= l.wl && s.w <= l.wh)) return s;
  }
}

double draw_displacement(Draw& draw, Kind kind, const Limits& l) {
  const double braking = number(l.wh * l.wh / l.bh + l.wh * sqrt(l.wh / l.uh));
  if (kind == Kind::round) return draw.sign() * draw.integer(0, 16) / 4.0;
  if (kind == Kind::tiny) return draw.chance(0.3) ? 0 : draw.sign() * draw.magnitude(1e-9, 1e-3);
  if (l.wl == 0 || l.wh == 0)
    return (l.wh > 0 ? 1 : -1) * draw.magnitude(2, 10) * number(std::max(l.wh, Number(-l.wl)) / l.bh);
  return draw.sign() * draw.magnitude(1e-2, 10) * braking;
}

Vector along(const std::vector<Number>& rho, const Number& scalar) {
  Vector values;
  for (const Number& ratio : rho) values.push_back(number(ratio * scalar));
  return values;
}

void draw_target(Draw& draw, Kind kind, KnownMove& known) {
  const Move& move = known.move;
  const Limits l = limits_on(known.line.rho, move);
  const bool rests = kind == Kind::at_rest && draw.chance(0.5);
  known.line.to_jerk = 0;
  if (move.type >= 6 && !rests) {
    draw_end_with_snap(draw, kind, move, known.line, true);
  } else {
    known.line.to =
        draw_end(draw, kind, l, has(move.type, "v1") && !rests, has(move.type, "a1") && !rests, true);
  }
  known.line.to.q = draw_displacement(draw, kind, l);
}

/// A target that phases + - + or - + - come to during which the acceleration keeps the sign that it has.
void bring_near(Draw& draw, const Move& move, Line& line) {
  const Limits l = limits_on(line.rho, move);
  const bool rests = !has(move.type, "a1");
  for (int tries = 0; tries < 1000; ++tries) {
    State from{0, line.from.w, number(draw.chance(0.5) ? l.bl : l.bh) * draw.in(0.05, 1)};
    const Number first = draw.chance(0.5) ? l.uh : l.ul, second = first == l.uh ? l.ul : l.uh;
    const auto some_time = [&](const Number& u) {
      return Number(number(abs(from.b / u)) * draw.magnitude(1e-3, 0.7));
    };
    Profile profile{"", {{some_time(first), first}, {some_time(second), second}}};
    const Number b = profile.end(from).b;
    profile.phases.push_back({rests ? Number(-b / first) : some_time(first), first});
    if (b * from.b < 0 || profile.phases.back().duration < 0) continue;
    if (!has(move.type, "v1")) from.w -= profile.end(from).w;
    from = {0, number(from.w), number(from.b)};
    State to = profile.end(from);
    to = {number(to.q), has(move.type, "v1") ? number(to.w) : 0, rests ? 0 : number(to.b)};
    if (!can_stop(from, l) || !can_have_started(to, l) || to.b * from.b < 0) continue;
    line.from = from;
    line.to = to;
    return;
  }
}

/// The vectors that a line and its ends give.
void write_vectors(KnownMove& known) {
  Move& move = known.move;
  const Line& line = known.line;
  move.v0 = along(line.rho, line.from.w);
  move.a0 = along(line.rho, line.from.b);
  move.p1 = along(line.rho, line.to.q);
  for (std::size_t k = 0; k < move.p1.size(); ++k) move.p1[k] += move.p0[k];
  move.v1 = along(line.rho, line.to.w);
  move.a1 = along(line.rho, line.to.b);
  move.j0 = along(line.rho, line.from_jerk);
  move.j1 = along(line.rho, line.to_jerk);
}

}  // namespace

std::string to_string(Kind kind) {
  constexpr const char* kNames[] = {"at_rest", "moving", "near_limits",  "round",   "beyond", "still",
                                    "tiny",    "scaled", "overshooting", "no_peak", "one_way"};
  return kNames[static_cast<std::size_t>(kind)];
}

Kind random_kind(Draw& draw) {
  return kKinds[static_cast<std::size_t>(draw.integer(0, static_cast<int>(std::size(kKinds)) - 1))];
}

KnownMove random_move(Draw& draw, int type, Kind kind, std::size_t joints) {
  KnownMove known;
  Move& move = known.move;
  move.type = type;
  draw_limits(draw, kind, move, joints);
  known.line.rho = draw_line(draw, kind, joints);
  if (kind == Kind::one_way) forbid_one_way(draw, move, known.line.rho);
  const Limits l = limits_on(known.line.rho, move);
  const bool with_b = type >= 3, rests = kind == Kind::at_rest;
  if (kind == Kind::beyond || kind == Kind::overshooting) {
    known.line.from = draw_beyond(draw, l, with_b);
  } else if (type >= 6 && !rests) {
    draw_end_with_snap(draw, kind, move, known.line, false);
  } else {
    known.line.from = draw_end(draw, kind, l, !rests, with_b && !rests, false);
  }
  for (std::size_t k = 0; k < joints; ++k) {
    const double p =
        draw.chance(0.2) ? 0 : draw.in(-2, 2) * (kind == Kind::scaled ? number(l.wh * l.wh / l.bh) : 1);
    move.p0.push_back(kind == Kind::round ? std::round(4 * p) / 4 : p);
  }
  draw_target(draw, kind, known);
  if (kind == Kind::no_peak && type >= 3 && type <= 5) bring_near(draw, move, known.line);
  write_vectors(known);
  return known;
}

Move shaken(Draw& draw, const Move& move, double by) {
  Move other = move;
  for (Vector* values : {&other.p0, &other.v0, &other.a0, &other.p1, &other.v1, &other.a1}) {
    for (double& x : *values) x *= 1 + by * draw.in(-1, 1);
  }
  return other;
}

Move crooked(Draw& draw, const Move& move) {
  Move other = move;
  const double off = draw.sign() * draw.magnitude(3 * move.tol, 0.5);
  std::vector<double*> components;
  for (const std::string& name : vectors_of(move.type)) {
    Vector& values = name == "p0"   ? other.p0
                     : name == "p1" ? other.p1
                     : name == "v0" ? other.v0
                     : name == "a0" ? other.a0
                     : name == "v1" ? other.v1
                     : name == "a1" ? other.a1
                     : name == "j0" ? other.j0
                                    : other.j1;
    for (double& x : values) {
      if (x != 0) components.push_back(&x);
    }
  }
  if (!components.empty())
    *components[static_cast<std::size_t>(draw.integer(0, static_cast<int>(components.size()) - 1))] *=
        1 + off;
  return other;
}

KnownMove replanned(Draw& draw, const KnownMove& known, const State& now, double jerk) {
  KnownMove next = known;
  for (std::size_t k = 0; k < known.line.rho.size(); ++k)
    next.move.p0[k] += number(known.line.rho[k] * now.q);
  next.line.from = {0, now.w, now.b};
  next.line.from_jerk = jerk;
  draw_target(draw, Kind::moving, next);
  write_vectors(next);
  next.move.line.clear();
  for (const Number& ratio : known.line.rho) next.move.line.push_back(number(ratio));
  return next;
}

}  // namespace hcsp::straight_line
