// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/comparison.h"

#include <algorithm>

#include "tests/straight_line/snap.h"

namespace hcsp::straight_line {

namespace {

Move of_type_five(Move move) {
  move.type = 5;
  return move;
}

}  // namespace

Comparison compared_with_oracle(const Move& move, const Answer& answer) {
  if (answer.bracket.hi <= 1e-9)
    return {0, ""};  // nothing is faster, and the states are too close to be told
  const Line line = line_of(move, answer);
  Comparison found{1e9, ""};
  for (int i = 0; i < 243 && found.off > 1e-9; ++i) {  // each number as it is, a little more, or less
    Line other = line;
    int digits = i;
    for (Number* x : {&other.from.w, &other.from.b, &other.to.q, &other.to.w, &other.to.b}) {
      *x *= 1 + Number((digits + 1) % 3 - 1) * 1.5e-12;
      digits /= 3;
    }
    const std::optional<Profile> best = fastest_along(other, move);
    if (!best) continue;
    const double T = best->duration().convert_to<double>();
    const double off = std::max({0.0, answer.bracket.lo - T, T - answer.bracket.hi});
    if (off < found.off) found = {off, best->word};
  }
  return found;
}

double least_with_snap(const Line& line, const Move& move) {
  const Limits l = limits_on(line.rho, move);
  if (!can_stop(line.from, l) || !can_have_started(line.to, l)) return 0;
  return fastest_along(line, of_type_five(move))->duration().convert_to<double>();
}

double enough_with_snap(const Line& line, const Move& move) {
  const Limits l = limits_on(line.rho, move);
  const Number h = (l.uh - l.ul) / snap_on(line.rho, move);
  Line shorter = line;
  shorter.to.q -= (line.from.w + line.to.w) * h / 2;
  const std::optional<Profile> fastest = fastest_along(shorter, of_type_five(move));
  if (!fastest) return std::numeric_limits<double>::infinity();
  return (fastest->duration() + h).convert_to<double>();
}

}  // namespace hcsp::straight_line
