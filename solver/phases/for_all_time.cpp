// SPDX-License-Identifier: Apache-2.0
#include "solver/phases/for_all_time.h"

#include <algorithm>

#include "solver/expression/operators.h"
#include "solver/phases/folding.h"

namespace hcsp {

namespace {

using folding::difference;
using folding::negated;
using folding::number;
using folding::product;
using folding::sum;

Expr compared(Expr a, Expr b, bool strict) { return strict ? a < b : a <= b; }
// True where literals tell.
Expr ordered(Expr a, Expr b, bool strict) {
  const DagNode &x = a.dag()[a.node()], &y = b.dag()[b.node()];
  if (x.op == Op::constant && y.op == Op::constant) {
    if (x.value.hi() < y.value.lo() || (!strict && x.value.hi() <= y.value.lo()))
      return {a.dag(), a.dag().constant(kTrue)};
  }
  return compared(a, b, strict);
}
Expr positive_part(Expr a) {
  const DagNode& node = a.dag()[a.node()];
  if (node.op == Op::constant && node.value.hi() <= 0.0) return number(a.dag(), 0.0);
  return node.op == Op::constant && node.value.lo() >= 0.0 ? a : max(a, number(a.dag(), 0.0));
}

// How fast a function grows at the start of a phase, and at its end.
Expr slope_at_start(const LocalPolynomial& p) {
  return p.degree() > 0 ? p.coefficients[1] : number(p.coefficients[0].dag(), 0.0);
}
Expr slope_at_end(const LocalPolynomial& p, Expr duration) {
  return p.degree() > 0 ? p.derivative().at(duration) : number(duration.dag(), 0.0);
}

// Within a phase of length tau, d = p - q = c0 + c1 s + c2 s^2/2 has a maximum between the ends when rise =
// max(c1, 0) and fall = max(-(c1 + c2 tau), 0) are positive. Then -c2 tau = rise + fall, and the maximum is
// c0 + tau rise^2/(2 (rise + fall)). Times the denominator, and times rise fall to be no condition where
// there is no such maximum. It is at most c0 + tau rise/2, so that a phase that hardly bends is decided by
// twice that. Slopes are taken of p and q: they are what a derivative is at gates, expressions that may be
// known.
Expr vertex_is_negative(const LocalPolynomial& p, const LocalPolynomial& q, Expr duration, bool strict) {
  const Expr rise = positive_part(difference(slope_at_start(p), slope_at_start(q)));
  const Expr fall = positive_part(difference(slope_at_end(q, duration), slope_at_end(p, duration)));
  const Expr zero = number(rise.dag(), 0.0), start = difference(p.coefficients[0], q.coefficients[0]);
  const Expr twice = product(number(rise.dag(), 2.0), start), growth = product(duration, rise);
  const Expr height = sum(product(twice, sum(rise, fall)), product(growth, rise));
  if (strict) return !(rise > zero && fall > zero) || height < zero;
  const Expr all = product(product(rise, fall), height);
  return all.dag()[all.node()].op == Op::constant ? ordered(all, zero, false)
                                                  : min(all, sum(twice, growth)) <= zero;
}

// Of a cubic the maximum is where the slope c1 + c2 s + c3 s^2/2 falls through 0: at s = (c2 + r)/-c3, r =
// sqrt(c2^2 - 2 c1 c3), where c3 < 0 <= c2, and otherwise at s = 2 c1/(r - c2), if that is positive. Where
// the cubic is monotone there is none, and the ends say it all: its slope is of one sign. At the maximum the
// cubic is its remainder by the slope, too, c0 - (c1 c2 + s (c2^2 - 2 c1 c3))/(3 c3), which tells more where
// the slope only just touches 0: the place of the maximum is then known by a square root of rounding.
Expr summit_is_negative(const LocalPolynomial& d, Expr duration, bool strict) {
  const LocalPolynomial slope = d.derivative();
  const Expr c1 = slope.coefficients[0], c2 = slope.coefficients[1], c3 = slope.coefficients[2];
  const Expr zero = number(c1.dag(), 0.0), two = number(c1.dag(), 2.0);
  const Expr discriminant = difference(product(c2, c2), product(two, product(c1, c3)));
  const Expr root = sqrt(max(discriminant, zero));
  const Expr below = difference(root, c2);
  const Expr early = if_then_else(c1 > zero && below > zero, product(two, c1) / below, zero);
  const Expr late = if_then_else(c3 < zero && c2 >= zero, sum(c2, root) / negated(c3), early);
  const Expr summit = max(zero, min(late, duration));
  const Expr remainder = d.coefficients[0] - (c1 * c2 + summit * discriminant) / (3.0 * c3);
  return compared(d.at(summit), zero, strict) || compared(remainder, zero, strict);
}

// a - b, of which the constant terms are told apart: the value is compared at the ends.
LocalPolynomial minus(const LocalPolynomial& a, const LocalPolynomial& b) {
  LocalPolynomial result;
  const Expr zero = number(a.coefficients[0].dag(), 0.0);
  for (std::size_t k = 0; k <= std::max(a.degree(), b.degree()); ++k) {
    const auto of = [&](const LocalPolynomial& p) { return k <= p.degree() ? p.coefficients[k] : zero; };
    result.coefficients.push_back(difference(of(a), of(b)));
  }
  while (result.degree() > 0 && folding::is_number(result.coefficients.back(), 0.0))
    result.coefficients.pop_back();
  return result;
}

// The slope of a piece: its value at the end is what a derivative is at that gate, which may be known.
Piece slope_of(const Piece& piece, Expr duration) {
  const LocalPolynomial slope = piece.polynomial.derivative();
  return {slope, slope.at(duration)};
}

// p <= q on one phase; false where the degree of p - q is too high.
bool add_less(const Piece& p, const Piece& q, Expr duration, bool strict, std::vector<Expr>& all) {
  all.push_back(ordered(p.start(), q.start(), strict));
  all.push_back(ordered(p.end, q.end, strict));
  const LocalPolynomial between = minus(p.polynomial, q.polynomial);
  if (between.degree() > 3) return false;
  if (between.degree() == 2) all.push_back(vertex_is_negative(p.polynomial, q.polynomial, duration, strict));
  if (between.degree() == 3) {
    const Piece rise = slope_of(p, duration), other = slope_of(q, duration);
    std::vector<Expr> falls, rises;
    add_less(rise, other, duration, false, falls);
    add_less(other, rise, duration, false, rises);
    all.push_back(folding::conjunction(duration.dag(), falls) ||
                  folding::conjunction(duration.dag(), rises) ||
                  summit_is_negative(between, duration, strict));
  }
  return true;
}

}  // namespace

std::vector<Expr> equal_for_all_time(const PhaseFunction& a, const PhaseFunction& b) {
  std::vector<Expr> all;
  const bool is_continuous = a.is_continuous() && b.is_continuous();
  for (std::size_t i = 0; i < a.pieces().size(); ++i) {
    const LocalPolynomial &p = a.pieces()[i].polynomial, &q = b.pieces()[i].polynomial;
    const Expr zero = number(p.coefficients[0].dag(), 0.0);
    for (std::size_t k = is_continuous && i > 0 ? 1 : 0; k <= std::max(p.degree(), q.degree()); ++k) {
      const auto of = [&](const LocalPolynomial& side) {
        return k <= side.degree() ? side.coefficients[k] : zero;
      };
      all.push_back(folding::equality(of(p), of(q)));
    }
  }
  return all;
}

std::optional<std::vector<Expr>> less_for_all_time(const std::vector<Expr>& durations, const PhaseFunction& a,
                                                   const PhaseFunction& b, bool strict) {
  std::vector<Expr> all;
  for (std::size_t i = 0; i < durations.size(); ++i) {
    if (!add_less(a.pieces()[i], b.pieces()[i], durations[i], strict, all)) return {};
  }
  return all;
}

std::vector<Expr> derivative_for_all_time(const PhaseFunction& x, const PhaseFunction& f) {
  std::vector<Piece> slopes;
  for (const Piece& piece : x.pieces()) {
    const LocalPolynomial slope = piece.polynomial.derivative();
    slopes.push_back({slope, slope.coefficients.front()});
  }
  // Known to be continuous or not, a slope may jump as f may: every coefficient is told.
  std::vector<Expr> all = equal_for_all_time(PhaseFunction(std::move(slopes), false), f);
  if (x.is_continuous()) return all;
  for (std::size_t i = 0; i + 1 < x.pieces().size(); ++i)
    all.push_back(folding::equality(x.pieces()[i].end, x.pieces()[i + 1].start()));
  return all;
}

}  // namespace hcsp
