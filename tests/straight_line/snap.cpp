// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/snap.h"

#include <algorithm>

namespace hcsp::straight_line {

namespace {

struct Moving {
  Number w, b, u;
};

Moving after(const Moving& m, const Number& t, const Number& snap) {
  return {m.w + t * (m.b + t * (m.u / 2 + t * snap / 6)), m.b + t * (m.u + t * snap / 2), m.u + t * snap};
}

/// The least velocity that a motion has where its acceleration turns from above zero to below, after which it
/// can be stopped at the limit `bl`: jerk falls to -peak, rests there, and comes back as far as it has to.
/// None where jerk is below that already.
std::optional<Number> turn(Moving m, const Number& bl, const Number& ul, const Number& snap) {
  const Number top = m.b + m.u * m.u / (2 * snap), last = sqrt(-2 * snap * bl);
  Number peak = sqrt(2 * snap * top);
  if (peak > last) peak = sqrt(snap * top + last * last / 2);
  peak = std::min(peak, Number(-ul));
  const Number back = (peak - std::min(peak, last)) / snap;
  const Number rest = (top - peak * peak / (2 * snap) - back * (peak - snap * back / 2)) / peak;
  if (m.u < -peak) return std::nullopt;
  for (const auto& [time, sign] :
       {std::pair{Number((m.u + peak) / snap), -1}, {std::max(rest, Number(0)), 0}, {back, 1}})
    m = after(m, time, sign * snap);
  return m.w;
}

bool stays_below(const State& s, const Number& u, const Limits& l, const Number& snap) {
  if (s.w > l.wh || s.b > l.bh || u > l.uh || (u > 0 && s.b + u * u / (2 * snap) > l.bh)) return false;
  return least_crest(s, u, l, snap) <= l.wh;
}

Number gain(const Number& change, const Number& jerk, const Number& snap) {
  const Number time =
      change > jerk * jerk / snap ? Number(jerk / snap + change / jerk) : Number(2 * sqrt(change / snap));
  return time * change / 2;
}

}  // namespace

Number snap_on(const std::vector<Number>& rho, const Move& move) {
  Number snap = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < rho.size(); ++k) {
    if (rho[k] != 0) snap = std::min(snap, Number(move.dmax[k] / abs(rho[k])));
  }
  return snap;
}

Number least_crest(const State& s, const Number& u, const Limits& l, const Number& snap) {
  if (s.b <= 0 && (u <= 0 || s.b + u * u / (2 * snap) <= 0)) return s.w;
  const std::optional<Number> w = turn({s.w, s.b, u}, l.bl, l.ul, snap);
  return w ? std::max(*w, s.w) : std::numeric_limits<Number>::infinity();
}

bool can_stop_with_snap(const State& s, const Number& jerk, const Limits& l, const Number& snap) {
  return stays_below(s, jerk, l, snap) && stays_below(mirrored(s), -jerk, mirrored(l), snap);
}

bool can_have_started_with_snap(const State& s, const Number& jerk, const Limits& l, const Number& snap) {
  return can_stop_with_snap({s.q, s.w, -s.b}, jerk, {l.wl, l.wh, -l.bh, -l.bl, l.ul, l.uh}, snap);
}

bool is_narrow(const Limits& l, const Number& snap) {
  const Number change = std::max(l.bh, Number(-l.bl));
  return gain(change, l.uh, snap) + gain(change, -l.ul, snap) > l.wh - l.wl;
}

}  // namespace hcsp::straight_line
