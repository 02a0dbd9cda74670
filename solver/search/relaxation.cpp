// SPDX-License-Identifier: Apache-2.0
#include "solver/search/relaxation.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"
#include "solver/search/curve.h"
#include "solver/search/mean_value.h"

namespace hcsp {

namespace {

Interval point(double x) { return Interval::raw(x, x); }
Interval at_least(double x) { return Interval::raw(x, kInfinity); }
Interval at_most(double x) { return Interval::raw(-kInfinity, x); }

}  // namespace

Relaxation::Relaxation(const System& system)
    : system_(system), run_(*system.tape), sums_(system.tape->registers()) {
  for (const auto& [reg, value] : system.tape->constants()) sums_[reg].rest = value;
  for (std::uint32_t v = 0; v < system.size(); ++v) sums_[v].terms = {{v, 1.0}};
}

bool Relaxation::state(std::vector<Interval>& box, LinearProgram& program) {
  run_.start(box);
  for (std::size_t i = 0; i < system_.relations.size(); ++i) {
    if (!run_.revise(i, system_.relations[i].wanted)) return false;
  }
  for (std::uint32_t v = 0; v < box.size(); ++v) box[v] = run_.variable(v);
  columns_ = box;
  rows_.clear();
  for (const Tape::Instruction& at : system_.tape->code()) state_instruction(at);
  for (std::size_t i = 0; i < system_.relations.size(); ++i)
    require(sums_[system_.tape->root(i)], system_.relations[i].wanted);
  program.start(columns_);
  for (const Row& row : rows_) program.add_row(row.terms, row.within);
  return true;
}

// Factors are rounded; what that leaves out goes to the rest.
Relaxation::Sum Relaxation::scaled(const Sum& sum, const Interval& factor) const {
  Sum result;
  result.rest = up::mul(sum.rest, factor);
  for (const LinearTerm& term : sum.terms) {
    const Interval exact = up::mul(point(term.factor), factor);
    const double rounded = middle_of(exact);
    result.terms.push_back({term.column, rounded});
    if (!exact.is_point())
      result.rest = up::add(result.rest, up::mul(up::sub(exact, point(rounded)), columns_[term.column]));
  }
  return result;
}

Relaxation::Sum Relaxation::added(const Sum& a, const Sum& b) const {
  Sum result;
  result.rest = up::add(a.rest, b.rest);
  auto i = a.terms.begin();
  auto j = b.terms.begin();
  while (i != a.terms.end() || j != b.terms.end()) {
    if (j == b.terms.end() || (i != a.terms.end() && i->column < j->column)) {
      result.terms.push_back(*i++);
      continue;
    }
    if (i == a.terms.end() || j->column < i->column) {
      result.terms.push_back(*j++);
      continue;
    }
    const Interval exact = up::add(point(i->factor), point(j->factor));
    const double rounded = middle_of(exact);
    if (rounded != 0.0) result.terms.push_back({i->column, rounded});
    if (!exact.is_point())
      result.rest = up::add(result.rest, up::mul(up::sub(exact, point(rounded)), columns_[i->column]));
    ++i;
    ++j;
  }
  return result;
}

Relaxation::Sum Relaxation::column_of(std::uint32_t reg) {
  columns_.push_back(run_.at(reg));
  return {{{static_cast<std::uint32_t>(columns_.size() - 1), 1.0}}, point(0.0)};
}

void Relaxation::state_instruction(const Tape::Instruction& at) {
  const Sum& a = sums_[at.a];
  const Sum& b = sums_[at.b];
  Sum& y = sums_[at.y];
  const bool is_a_known = a.terms.empty(), is_b_known = at.arity < 2 || b.terms.empty();
  if (is_a_known && is_b_known) {
    y = {{}, run_.at(at.y)};
    return;
  }
  switch (at.op) {
    case Op::neg:
      y = scaled(a, point(-1.0));
      return;
    case Op::add:
      y = added(a, b);
      return;
    case Op::sub:
      y = added(a, scaled(b, point(-1.0)));
      return;
    case Op::mul:
      if (is_a_known || is_b_known) {
        y = is_a_known ? scaled(b, a.rest) : scaled(a, b.rest);
        return;
      }
      y = column_of(at.y);
      return state_product(y, run_.at(at.a), a, run_.at(at.b), b);
    case Op::div:
      if (is_b_known) {
        y = scaled(a, up::div(point(1.0), b.rest));
        return;
      }
      y = column_of(at.y);
      if (is_a_known) return state_curve(at, at.b);
      return state_product(a, run_.at(at.y), y, run_.at(at.b), b);
    case Op::max:
    case Op::min:
      y = column_of(at.y);
      for (const Sum* operand : {&a, &b})
        require(added(y, scaled(*operand, point(-1.0))), at.op == Op::max ? at_least(0.0) : at_most(0.0));
      return;
    default:
      y = column_of(at.y);
      if (is_curve(at.op) && is_b_known) state_curve(at, at.a);
  }
}

// Of a product of a in [a1, a2] and b in [b1, b2], (a - a1)(b - b1) >= 0 and so on.
void Relaxation::state_product(const Sum& product, const Interval& a, const Sum& of_a, const Interval& b,
                               const Sum& of_b) {
  const auto corner = [&](double at_a, double at_b, bool is_below) {
    if (!std::isfinite(at_a) || !std::isfinite(at_b)) return;
    const Sum plane = added(added(product, scaled(of_a, point(-at_b))), scaled(of_b, point(-at_a)));
    const Interval constant = -up::mul(point(at_a), point(at_b));
    require(plane, is_below ? at_least(constant.lo()) : at_most(constant.hi()));
  };
  corner(a.lo(), b.lo(), true);
  corner(a.hi(), b.hi(), true);
  corner(a.lo(), b.hi(), false);
  corner(a.hi(), b.lo(), false);
}

void Relaxation::state_curve(const Tape::Instruction& at, std::uint32_t argument) {
  const Interval& x = run_.at(argument);
  const std::uint32_t other = argument == at.a ? at.b : at.a;
  const Curve curve{at.op, at.arity < 2 ? point(0.0) : run_.at(other)};
  if (x.is_point() || (at.op == Op::pow && !(x.lo() >= 0))) return;
  const Sum& y = sums_[at.y];
  // y - slope x lies within what it does at the line.
  const auto line = [&](double slope, const Interval& within) {
    if (std::isfinite(slope)) require(added(y, scaled(sums_[argument], point(-slope))), within);
  };
  const Interval bend = curve.bend(x);
  if (bend.lo() >= 0.0 || bend.hi() <= 0.0) {
    const bool is_convex = bend.lo() >= 0.0;
    const auto tangent = [&](double p) {
      if (!std::isfinite(p)) return;
      const Interval value = curve.value(point(p)), slope = curve.slope(point(p));
      if (value.is_empty() || !value.is_bounded() || slope.is_empty() || !slope.is_bounded()) return;
      const double d = middle_of(slope);
      const Interval error = up::mul(up::sub(slope, point(d)), up::sub(x, point(p)));
      const Interval at_zero = up::add(up::sub(value, up::mul(point(d), point(p))), error);
      line(d, is_convex ? at_least(at_zero.lo()) : at_most(at_zero.hi()));
    };
    tangent(x.lo());
    tangent(x.hi());
    if (x.is_bounded()) tangent(middle_of(x));
    if (!x.is_bounded()) return;
    const Interval first = curve.value(point(x.lo())), last = curve.value(point(x.hi()));
    if (first.is_empty() || !first.is_bounded() || last.is_empty() || !last.is_bounded()) return;
    const double d = middle_of(up::div(up::sub(last, first), up::sub(point(x.hi()), point(x.lo()))));
    const Interval at_zero = join(up::sub(first, up::mul(point(d), point(x.lo()))),
                                  up::sub(last, up::mul(point(d), point(x.hi()))));
    return line(d, is_convex ? at_most(at_zero.hi()) : at_least(at_zero.lo()));
  }
  // Slopes say nothing across a pole.
  const Interval slope = curve.slope(x);
  if (slope.is_empty() || !curve.value(x).is_bounded()) return;
  const auto fan = [&](double p, double below, double above) {
    if (!std::isfinite(p)) return;
    const Interval value = curve.value(point(p));
    if (value.is_empty() || !value.is_bounded()) return;
    if (std::isfinite(below)) line(below, at_least(up::sub(value, up::mul(point(below), point(p))).lo()));
    if (std::isfinite(above)) line(above, at_most(up::sub(value, up::mul(point(above), point(p))).hi()));
  };
  fan(x.lo(), slope.lo(), slope.hi());
  fan(x.hi(), slope.hi(), slope.lo());
}

// In a scale that suits the simplex method, with the largest factor about 1; what is tiny beside it goes to
// the rest.
void Relaxation::require(const Sum& sum, const Interval& within) {
  constexpr double kTiny = 1e-10, kMost = 1e15;
  Interval left = up::sub(within, sum.rest);
  double most = 0.0;
  for (const LinearTerm& term : sum.terms) most = std::max(most, std::abs(term.factor));
  if (!(most > 0.0) || !std::isfinite(most) || left.is_empty()) return;
  const double scale = std::ldexp(1.0, -std::clamp(std::ilogb(most), -1000, 1000));
  Row row;
  for (const LinearTerm& term : sum.terms) {
    if (std::abs(term.factor) * scale < kTiny) {
      left = up::sub(left, up::mul(point(term.factor), columns_[term.column]));
    } else {
      row.terms.push_back({term.column, term.factor * scale});
    }
  }
  row.within = up::mul(left, point(scale));
  if (row.within.lo() > -kMost || row.within.hi() < kMost) rows_.push_back(std::move(row));
}

}  // namespace hcsp
