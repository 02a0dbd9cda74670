// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hcsp::straight_line {

namespace {

using Real = long double;

struct Ends {
  Real w0, b0, w1, b1;
  Real wh, bl, bh, ul, uh;
};

Real real(const Number& x) { return x.convert_to<Real>(); }

Ends ends(const State& from, const State& to, const Limits& l) {
  return {real(from.w), real(from.b), real(to.w), real(to.b), real(l.wh),
          real(l.bl),   real(l.bh),   real(l.ul), real(l.uh)};
}

struct Way {
  Real time, displacement;
};

/// From (w, b) to (wh, 0) as fast as possible: u up to a turning point, a hold at bh, v down to 0.
Way rise(Real w, Real b, Real wh, Real bh, Real u, Real v) {
  const Real k = (1 / u - 1 / v) / 2;
  const Real rest = std::max(wh - w + b * b / (2 * u), 0.0L);
  const Real turn = std::min(std::sqrt(rest / k), bh);
  const Real times[] = {std::max((turn - b) / u, 0.0L), std::max(rest - k * turn * turn, 0.0L) / bh,
                        -turn / v};
  const Real jerks[] = {u, 0, v};
  Real q = 0;
  for (int i = 0; i < 3; ++i) {
    const Real t = times[i];
    q += t * (w + t * (b / 2 + t * jerks[i] / 6));
    w += t * (b + t * jerks[i] / 2);
    b += t * jerks[i];
  }
  return {times[0] + times[1] + times[2], q};
}

/// b_c of the page: max(L, min(H, c + ul t)).
Real acceleration(const Ends& e, Real T, Real c, Real t) {
  const Real high = std::min({e.b0 + e.uh * t, e.bh, e.b1 - e.ul * (T - t)});
  const Real low = std::max({e.b0 + e.ul * t, e.bl, e.b1 - e.uh * (T - t)});
  return std::max(low, std::min(high, c + e.ul * t));
}

/// Where the lines of which b_c is made meet, in order, with 0 and T.
std::vector<Real> corners(const Ends& e, Real T, Real c) {
  const std::pair<Real, Real> lines[] = {{e.b0, e.uh}, {e.bh, 0}, {e.b1 - e.ul * T, e.ul},
                                         {e.b0, e.ul}, {e.bl, 0}, {e.b1 - e.uh * T, e.uh},
                                         {c, e.ul}};
  std::vector<Real> found{0, T};
  for (const auto& [a, slope] : lines) {
    for (const auto& [a2, slope2] : lines) {
      const Real t = slope == slope2 ? 0 : (a2 - a) / (slope - slope2);
      if (t > 0 && t < T) found.push_back(t);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The velocity gained and the displacement under b_c.
std::pair<Real, Real> integral(const Ends& e, Real T, Real c) {
  Real w = e.w0, q = 0, last = 0, b = acceleration(e, T, c, 0);
  for (const Real t : corners(e, T, c)) {
    const Real h = t - last, next = acceleration(e, T, c, t);
    q += h * (w + h * (2 * b + next) / 6);
    w += h * (b + next) / 2;
    b = next;
    last = t;
  }
  return {w, q};
}

std::optional<Real> greatest(const Ends& e, Real T) {
  const Real play = 1e-15L * (e.wh - e.bl + std::abs(e.w0) + e.bh * T);
  if (e.b1 - e.b0 > e.uh * T + play || e.b1 - e.b0 < e.ul * T - play) return std::nullopt;
  const Way up = rise(e.w0, e.b0, e.wh, e.bh, e.uh, e.ul);
  const Way down = rise(e.w1, -e.b1, e.wh, -e.bl, e.uh, e.ul);  // backward in time
  if (up.time + down.time <= T) return up.displacement + down.displacement + e.wh * (T - up.time - down.time);
  Real low = e.bl - 1, high = e.bh - e.ul * T + 1;
  if (integral(e, T, low).first > e.w1 + play || integral(e, T, high).first < e.w1 - play)
    return std::nullopt;
  for (int i = 0; i < 80; ++i) {
    const Real c = (low + high) / 2;
    (integral(e, T, c).first < e.w1 ? low : high) = c;
  }
  return integral(e, T, high).second;
}

}  // namespace

std::optional<Range> reach(const State& from, const State& to, const Limits& l, Real T) {
  const std::optional<Real> most = greatest(ends(from, to, l), T);
  const std::optional<Real> least = greatest(ends(mirrored(from), mirrored(to), mirrored(l)), T);
  if (!most || !least) return std::nullopt;
  return Range{-*least, *most};
}

}  // namespace hcsp::straight_line
