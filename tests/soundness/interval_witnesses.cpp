// SPDX-License-Identifier: Apache-2.0
// Real solutions for the reverse operations: from a value c, and the other argument b where there is one, the
// solution x of f(x, b) = c, which is seldom a double. A result must hold the doubles on either side of it;
// doubles alone would not show a bound rounded to nearest.
#include <cmath>
#include <utility>

#include "tests/soundness/interval_sources.h"

namespace hcsp::campaign {

namespace {

constexpr mpfr_prec_t kPrecision = 256;

/// The doubles around a number known to 200 bits; one that is a double in these is taken for exact.
Bracket bracket_of(mpfr_srcptr x) {
  mpfr_t known;
  mpfr_init2(known, 200);
  mpfr_set(known, x, MPFR_RNDN);
  const Bracket result{mpfr_get_d(known, MPFR_RNDD), mpfr_get_d(known, MPFR_RNDU)};
  mpfr_clear(known);
  return result;
}

void add_turns(mpfr_ptr x, double half_turns) {
  mpfr_t pi;
  mpfr_init2(pi, kPrecision);
  mpfr_const_pi(pi, MPFR_RNDN);
  mpfr_mul_d(pi, pi, half_turns, MPFR_RNDN);
  mpfr_add(x, x, pi, MPFR_RNDN);
  mpfr_clear(pi);
}

double half_turns(Draw& draw) {
  return std::trunc(draw.below(2) == 0 ? draw.within(-8.0, 8.0) : draw.within(-0x1p29, 0x1p29));
}

void flip_by_chance(mpfr_ptr x, Draw& draw) {
  if (draw.below(2) == 0) mpfr_neg(x, x, MPFR_RNDN);
}

// Each sets x to a solution, and returns false where there is none or it is not meant.

bool square_root(mpfr_ptr x, double, double c, Draw& draw) {
  if (c < 0) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_sqrt(x, x, MPFR_RNDN);
  flip_by_chance(x, draw);
  return true;
}

bool arcsine(mpfr_ptr x, double, double c, Draw& draw) {
  if (std::abs(c) > 1) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_asin(x, x, MPFR_RNDN);
  const double n = half_turns(draw);
  if (std::fmod(n, 2.0) != 0) mpfr_neg(x, x, MPFR_RNDN);
  add_turns(x, n);
  return true;
}

bool arccosine(mpfr_ptr x, double, double c, Draw& draw) {
  if (std::abs(c) > 1) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_acos(x, x, MPFR_RNDN);
  flip_by_chance(x, draw);
  add_turns(x, 2 * half_turns(draw));
  return true;
}

bool arctangent(mpfr_ptr x, double, double c, Draw& draw) {
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_atan(x, x, MPFR_RNDN);
  add_turns(x, half_turns(draw));
  return true;
}

bool area_cosine(mpfr_ptr x, double, double c, Draw& draw) {
  if (c < 1) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_acosh(x, x, MPFR_RNDN);
  flip_by_chance(x, draw);
  return true;
}

bool quotient(mpfr_ptr x, double b, double c, Draw&) {
  if (b == 0) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_div_d(x, x, b, MPFR_RNDN);
  return true;
}

/// x^b = c.
bool base(mpfr_ptr x, double b, double c, Draw&) {
  if (b == 0 || c <= 0) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_log(x, x, MPFR_RNDN);
  mpfr_div_d(x, x, b, MPFR_RNDN);
  // Far enough from over- and underflow in MPFR; next to 1, exp may need more than these bits.
  if (mpfr_cmpabs_ui(x, 800) > 0 || (!mpfr_zero_p(x) && mpfr_get_exp(x) < -100)) return false;
  mpfr_exp(x, x, MPFR_RNDN);
  return true;
}

/// b^x = c.
bool exponent(mpfr_ptr x, double b, double c, Draw&) {
  if (b <= 0 || b == 1 || c <= 0) return false;
  mpfr_t log_b;
  mpfr_init2(log_b, kPrecision);
  mpfr_set_d(log_b, b, MPFR_RNDN);
  mpfr_log(log_b, log_b, MPFR_RNDN);
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_log(x, x, MPFR_RNDN);
  mpfr_div(x, x, log_b, MPFR_RNDN);
  mpfr_clear(log_b);
  return true;
}

/// Whether the vector whose coordinate along an axis is b can have the angle c, the other one being x.
bool ordinate(mpfr_ptr x, double b, double c, Draw&) {
  if (std::abs(c) > 0x1.921fb54442d18p+1 || b == 0 || (std::abs(c) <= 0x1.921fb54442d18p+0) != (b > 0))
    return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_tan(x, x, MPFR_RNDN);
  mpfr_mul_d(x, x, b, MPFR_RNDN);
  return true;
}

bool abscissa(mpfr_ptr x, double b, double c, Draw&) {
  if (std::abs(c) > 0x1.921fb54442d18p+1 || b == 0 || c == 0 || (c > 0) != (b > 0)) return false;
  mpfr_set_d(x, c, MPFR_RNDN);
  mpfr_tan(x, x, MPFR_RNDN);
  mpfr_d_div(x, b, x, MPFR_RNDN);
  return true;
}

/// Sets x to a solution of f(x, other) = value; false where it finds none.
using Solve = std::function<bool(mpfr_ptr x, double other, double value, Draw&)>;
struct Reverse {
  Solve solve;
  Focus other, value;
  bool with_other = false;
};

struct Witness {
  double other, value;
  Bracket solution;
};

class WitnessSource final : public Source {
 public:
  WitnessSource(const Reverse& reverse, std::size_t count, Draw& draw)
      : with_other_(reverse.with_other), pool_(1000, reverse.value, draw) {
    mpfr_t x;
    mpfr_init2(x, kPrecision);
    while (witnesses_.size() < count) {
      const double b = draw.number(reverse.other), c = draw.number(reverse.value);
      if (reverse.solve(x, b, c, draw) && mpfr_number_p(x) != 0) witnesses_.push_back({b, c, bracket_of(x)});
    }
    mpfr_clear(x);
  }

  Case next(Draw& draw) override {
    const Witness& w = witnesses_[draw.below(witnesses_.size())];
    const double other = pool_[1 + draw.below(pool_.size() - 2)];
    const Interval c = around({w.value, w.value}, {other, other}, draw);
    Case result;
    const std::size_t first = with_other_ ? 1 : 0;
    if (with_other_) result.in[0] = holding({w.other, w.other}, draw);
    result.in[first] = c;
    result.in[first + 1] = holding(w.solution, draw);
    if (is_reached({w.value, w.value}, c)) result.must_hold(w.solution);
    return result;
  }

 private:
  /// An interval around a number.
  Interval holding(const Bracket& b, Draw& draw) const {
    const double p = pool_[draw.below(pool_.size() - 1)], q = pool_[1 + draw.below(pool_.size() - 1)];
    switch (draw.below(8)) {
      case 0:
        return Interval::raw(b.lo, kInfinity);
      case 1:
        return Interval::raw(-kInfinity, b.hi);
      case 2:
        return Interval::entire();
      case 3:
      case 4:
        return Interval::raw(std::min(b.lo, p), std::max(b.hi, q));
      default:
        return Interval::raw(b.lo, b.hi);
    }
  }

  bool with_other_;
  Pool pool_;
  std::vector<Witness> witnesses_;
};

/// From one source and the other in turn.
class BothSources final : public Source {
 public:
  BothSources(std::unique_ptr<Source> a, std::unique_ptr<Source> b) : sources_{std::move(a), std::move(b)} {}
  Case next(Draw& draw) override { return sources_[turn_ ^= 1U]->next(draw); }

 private:
  std::array<std::unique_ptr<Source>, 2> sources_;
  unsigned turn_ = 0;
};

Solve solution_of_power(int n) {
  return [n](mpfr_ptr x, double, double c, Draw& draw) {
    if (n == 0) return mpfr_set_d(x, c, MPFR_RNDN), c == 1;  // any x will do
    if ((c < 0 && n % 2 == 0) || (c == 0 && n < 0)) return false;
    mpfr_set_d(x, c, MPFR_RNDN);
    mpfr_rootn_si(x, x, n, MPFR_RNDN);
    if (n % 2 == 0) flip_by_chance(x, draw);
    return true;
  };
}

/// By the name of the operation.
Reverse reverse_of(const std::string& name) {
  const Focus unit{-1.0, 1.0, {-1.0, 1.0}}, angle{-3.2, 3.2, {0x1.921fb54442d18p+0, 0x1.921fb54442d18p+1}};
  const Focus positive{0.0, 10.0, {1.0}};
  if (name == "sqr_rev") return {square_root, {}, positive, false};
  if (name == "sin_rev") return {arcsine, {}, unit, false};
  if (name == "cos_rev") return {arccosine, {}, unit, false};
  if (name == "tan_rev") return {arctangent, {}, {}, false};
  if (name == "cosh_rev") return {area_cosine, {}, positive, false};
  if (name == "mul_rev" || name == "mul_rev_to_pair") return {quotient, {}, {}, true};
  if (name == "pow_rev1") return {base, {}, positive, true};
  if (name == "pow_rev2") return {exponent, positive, positive, true};
  if (name == "atan2_rev1") return {ordinate, {}, angle, true};
  return {abscissa, {}, angle, true};
}

}  // namespace

Operation with_witnesses(Operation operation, std::size_t count) {
  const auto sources = operation.source;
  const bool is_power = operation.name == "pown_rev";
  const Reverse of_name = is_power ? Reverse{} : reverse_of(operation.name);
  operation.source = [=](Draw& draw, std::size_t variant) {
    Reverse reverse = of_name;
    if (is_power) reverse.solve = solution_of_power(kExponents[variant]);
    return std::make_unique<BothSources>(sources(draw, variant),
                                         std::make_unique<WitnessSource>(reverse, count, draw));
  };
  return operation;
}

}  // namespace hcsp::campaign
