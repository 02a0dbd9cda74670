// SPDX-License-Identifier: Apache-2.0
// The decoration of a result is the worst of its operands' and of what holds for the operation on their box
// (IEEE 1788-2015, 11.6).
#include "domains/interval/decorated.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "domains/interval/numeric.h"
#include "domains/interval/reverse.h"

namespace hcsp {

namespace {

Decoration best_of(const Interval& a) {
  if (a.is_empty()) return Decoration::trv;
  return a.is_bounded() ? Decoration::com : Decoration::dac;
}

/// What holds for an operation on a box, before bounds are looked at.
Decoration local(bool defined, bool continuous) {
  return !defined ? Decoration::trv : (continuous ? Decoration::com : Decoration::def);
}

template <class... Operands>
DecoratedInterval decorate(const Interval& result, Decoration holds, const Operands&... operands) {
  if ((operands.is_nai() || ...)) return DecoratedInterval::nai();
  return {result, std::min({holds, operands.decoration()...})};
}

/// An operation that is continuous on its domain.
template <class... Operands>
DecoratedInterval smooth(const Interval& result, bool defined, const Operands&... operands) {
  return decorate(result, local(defined, true), operands...);
}

// What is asked of bounds goes through the comparisons of numeric.h, which see subnormal numbers even where
// the caller flushes them. All hold of the empty set, save the first.
bool has_zero(const DecoratedInterval& a) { return is_member(0.0, a.interval()); }
bool is_above(const DecoratedInterval& a, double x) { return strict_precedes(x, a.interval()); }
bool is_nowhere_negative(const DecoratedInterval& a) { return precedes(0.0, a.interval()); }

/// A step function is continuous on a box where it is constant, and at each point of it where it is constant
/// around the box, too.
DecoratedInterval step(Interval (*f)(const Interval&), const DecoratedInterval& a) {
  const Interval& x = a.interval();
  const Interval y = f(x);
  if (!y.is_point()) return decorate(y, Decoration::def, a);
  const Interval wider(std::nextafter(x.lo(), -kInfinity), std::nextafter(x.hi(), kInfinity));
  return decorate(y, f(wider) == y ? Decoration::com : Decoration::dac, a);
}

}  // namespace

DecoratedInterval::DecoratedInterval(const Interval& a) : interval_(a), decoration_(best_of(a)) {}

DecoratedInterval::DecoratedInterval(const Interval& a, Decoration d)
    : interval_(d == Decoration::ill ? Interval::empty() : a), decoration_(std::min(d, best_of(a))) {}

DecoratedInterval DecoratedInterval::nai() { return {Interval::empty(), Decoration::ill}; }

std::string to_string(const DecoratedInterval& a) {
  switch (a.decoration()) {
    case Decoration::ill:
      return "[nai]";
    case Decoration::trv:
      return to_string(a.interval()) + "_trv";
    case Decoration::def:
      return to_string(a.interval()) + "_def";
    case Decoration::dac:
      return to_string(a.interval()) + "_dac";
    default:
      return to_string(a.interval()) + "_com";
  }
}

using D = DecoratedInterval;

D operator-(const D& a) { return smooth(-a.interval(), true, a); }
D operator+(const D& a, const D& b) { return smooth(a.interval() + b.interval(), true, a, b); }
D operator-(const D& a, const D& b) { return smooth(a.interval() - b.interval(), true, a, b); }
D operator*(const D& a, const D& b) { return smooth(a.interval() * b.interval(), true, a, b); }
D operator/(const D& a, const D& b) { return smooth(a.interval() / b.interval(), !has_zero(b), a, b); }
D recip(const D& a) { return smooth(recip(a.interval()), !has_zero(a), a); }
D sqr(const D& a) { return smooth(sqr(a.interval()), true, a); }
D sqrt(const D& a) { return smooth(sqrt(a.interval()), is_nowhere_negative(a), a); }
D fma(const D& a, const D& b, const D& c) {
  return smooth(fma(a.interval(), b.interval(), c.interval()), true, a, b, c);
}
D pown(const D& a, int n) { return smooth(pown(a.interval(), n), n >= 0 || !has_zero(a), a); }
D pow(const D& a, const D& b) {
  const bool defined = is_above(a, 0.0) || (is_nowhere_negative(a) && is_above(b, 0.0));
  return smooth(pow(a.interval(), b.interval()), defined, a, b);
}
D rootn(const D& a, int n) {
  const bool has_root = n % 2 != 0 || is_nowhere_negative(a);
  return smooth(rootn(a.interval(), n), has_root && (n > 0 || !has_zero(a)), a);
}
D exp(const D& a) { return smooth(exp(a.interval()), true, a); }
D exp2(const D& a) { return smooth(exp2(a.interval()), true, a); }
D exp10(const D& a) { return smooth(exp10(a.interval()), true, a); }
D expm1(const D& a) { return smooth(expm1(a.interval()), true, a); }
D log(const D& a) { return smooth(log(a.interval()), is_above(a, 0.0), a); }
D log2(const D& a) { return smooth(log2(a.interval()), is_above(a, 0.0), a); }
D log10(const D& a) { return smooth(log10(a.interval()), is_above(a, 0.0), a); }
D log1p(const D& a) { return smooth(log1p(a.interval()), is_above(a, -1.0), a); }
D sin(const D& a) { return smooth(sin(a.interval()), true, a); }
D cos(const D& a) { return smooth(cos(a.interval()), true, a); }
D tan(const D& a) {
  const Interval image = tan(a.interval());
  return smooth(image, image.is_bounded(), a);  // a pole makes it the whole line
}
D asin(const D& a) { return smooth(asin(a.interval()), subset(a.interval(), {-1.0, 1.0}), a); }
D acos(const D& a) { return smooth(acos(a.interval()), subset(a.interval(), {-1.0, 1.0}), a); }
D atan(const D& a) { return smooth(atan(a.interval()), true, a); }
// The angle jumps across the negative half of the x axis, where it is that of the points above: on the axis
// alone, and above it, it is continuous.
D atan2(const D& y, const D& x) {
  const bool touches_cut = has_zero(y) && !is_nowhere_negative(x);
  const bool crosses_cut = touches_cut && !is_nowhere_negative(y);
  const Decoration holds = crosses_cut ? Decoration::def : (touches_cut ? Decoration::dac : Decoration::com);
  const bool defined = !(has_zero(y) && has_zero(x));
  return decorate(atan2(y.interval(), x.interval()), defined ? holds : Decoration::trv, y, x);
}
D sinh(const D& a) { return smooth(sinh(a.interval()), true, a); }
D cosh(const D& a) { return smooth(cosh(a.interval()), true, a); }
D tanh(const D& a) { return smooth(tanh(a.interval()), true, a); }
D asinh(const D& a) { return smooth(asinh(a.interval()), true, a); }
D acosh(const D& a) { return smooth(acosh(a.interval()), a.interval().lo() >= 1, a); }
D atanh(const D& a) { return smooth(atanh(a.interval()), interior(a.interval(), {-1.0, 1.0}), a); }
D sign(const D& a) { return step(sign, a); }
D ceil(const D& a) { return step(ceil, a); }
D floor(const D& a) { return step(floor, a); }
D trunc(const D& a) { return step(trunc, a); }
D round_ties_to_even(const D& a) { return step(round_ties_to_even, a); }
D round_ties_to_away(const D& a) { return step(round_ties_to_away, a); }
D abs(const D& a) { return smooth(abs(a.interval()), true, a); }
D min(const D& a, const D& b) { return smooth(min(a.interval(), b.interval()), true, a, b); }
D max(const D& a, const D& b) { return smooth(max(a.interval(), b.interval()), true, a, b); }

std::array<D, 2> mul_rev_to_pair(const D& b, const D& c) {
  if (b.is_nai() || c.is_nai()) return {D::nai(), D::nai()};
  const auto [first, second] = mul_rev_to_pair(b.interval(), c.interval());
  const D rest(second, Decoration::trv);
  return {has_zero(b) ? D(first, Decoration::trv) : c / b, rest};
}

}  // namespace hcsp
