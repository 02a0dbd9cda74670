// SPDX-License-Identifier: Apache-2.0
// The operations of the campaign, and their meaning in terms of MPFR's.
#include <algorithm>
#include <cmath>
#include <utility>

#include "domains/interval/functions.h"
#include "domains/interval/interval.h"
#include "domains/interval/numeric.h"
#include "domains/interval/reverse.h"
#include "tests/soundness/interval_sources.h"

namespace hcsp::campaign {

namespace {

// MPFR evaluations before the first case of a run of 10^6: one a number of the pool, one a point of the grid.
// A case has its bounds and samples among them; the functions evaluated case by case take 4 to 16 for each.
constexpr std::size_t kPool = 250000, kSide = 320, kWitnesses = 20000;

using OneArgument = Interval (*)(const Interval&);
using TwoArguments = Interval (*)(const Interval&, const Interval&);
using ThreeArguments = Interval (*)(const Interval&, const Interval&, const Interval&);

At by(Unary f) {
  return [f](double x) { return bracket_of(f, x); };
}

// ---- Functions of one variable.

constexpr Piece kLine{-kInfinity, kInfinity}, kNegative{-kInfinity, -0.0}, kPositive{0.0, kInfinity};

int recip_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t direction) { return mpfr_ui_div(r, 1, x, direction); }
int sign_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t direction) {
  return mpfr_set_si(r, mpfr_sgn(x), direction);
}
int minus(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t direction) { return mpfr_neg(r, x, direction); }
int magnitude(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t direction) { return mpfr_abs(r, x, direction); }
// The result of rounding to an integer has all its 53 bits: nothing is left to the ternary value.
int ceil_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t) { return mpfr_ceil(r, x), 0; }
int floor_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t) { return mpfr_floor(r, x), 0; }
int trunc_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t) { return mpfr_trunc(r, x), 0; }
int even_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t) { return mpfr_roundeven(r, x), 0; }
int away_of(mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t) { return mpfr_round(r, x), 0; }

Operation unary(std::string name, OneArgument f, const Monotone& meaning) {
  return {std::move(name),
          1,
          Promise::tightest,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{f(a[0]), {}};
          },
          [meaning](Draw& draw, std::size_t) { return monotone_source(meaning, kPool, draw); }};
}

Operation unary(std::string name, OneArgument f, Unary meaning, std::vector<Piece> pieces, Focus focus = {}) {
  return unary(std::move(name), f, Monotone{by(meaning), std::move(pieces), std::move(focus)});
}

Operation wave(std::string name, OneArgument f, Wave meaning) {
  return {std::move(name),
          1,
          Promise::tightest,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{f(a[0]), {}};
          },
          [meaning](Draw& draw, std::size_t) { return wave_source(meaning, kPool, draw); }};
}

void add_exponentials(std::vector<Operation>& all) {
  const Focus to_e{-750.0, 712.0, {-0x1.74910d52d3051p9, 0x1.62e42fefa39efp9, 0x1p-53, -0x1p-54}};
  all.push_back(unary("exp", exp, mpfr_exp, {kLine}, to_e));
  all.push_back(unary("exp2", exp2, mpfr_exp2, {kLine}, {-1080.0, 1030.0, {-1074.0, -1022.0, 1024.0}}));
  all.push_back(unary("exp10", exp10, mpfr_exp10, {kLine}, {-326.0, 310.0, {-323.30621534, 308.25471556}}));
  all.push_back(unary("expm1", expm1, mpfr_expm1, {kLine}, {-40.0, 712.0, {0x1.62e42fefa39efp9, -37.4}}));
  const std::vector<Piece> positive = {{0.0, kInfinity}};
  const Focus near_one{0.5, 2.0, {0.0, 1.0, 0x1p-1022}};
  all.push_back(unary("log", log, mpfr_log, positive, near_one));
  all.push_back(unary("log2", log2, mpfr_log2, positive, near_one));
  all.push_back(unary("log10", log10, mpfr_log10, positive, {0.0, 1000.0, {0.0, 1.0, 10.0, 1e22}}));
  all.push_back(unary("log1p", log1p, mpfr_log1p, {{-1.0, kInfinity}}, {-1.5, 3.0, {-1.0, 0.0}}));
}

void add_circular(std::vector<Operation>& all) {
  const std::vector<Piece> unit = {{-1.0, 1.0}};
  const Focus in_unit{-1.1, 1.1, {-1.0, -0.5, 0.5, 1.0}};
  all.push_back(wave("sin", sin, Wave::sin));
  all.push_back(wave("cos", cos, Wave::cos));
  all.push_back(wave("tan", tan, Wave::tan));
  all.push_back(unary("asin", asin, mpfr_asin, unit, in_unit));
  all.push_back(unary("acos", acos, mpfr_acos, unit, in_unit));
  all.push_back(unary("atan", atan, mpfr_atan, {kLine}));
  const Focus moderate{-715.0, 715.0, {0.0, 1.0, 0x1.633ce8fb9f87dp9, -0x1.633ce8fb9f87dp9}};
  all.push_back(unary("sinh", sinh, mpfr_sinh, {kLine}, moderate));
  all.push_back(unary("cosh", cosh, mpfr_cosh, {kNegative, kPositive}, moderate));
  all.push_back(unary("tanh", tanh, mpfr_tanh, {kLine}, {-20.0, 20.0, {-19.06, 19.06}}));
  all.push_back(unary("asinh", asinh, mpfr_asinh, {kLine}));
  all.push_back(unary("acosh", acosh, mpfr_acosh, {{1.0, kInfinity}}, {0.0, 10.0, {1.0}}));
  all.push_back(unary("atanh", atanh, mpfr_atanh, unit, in_unit));
}

void add_steps(std::vector<Operation>& all) {
  const Focus focus{-100.0, 100.0, {-1.0, 0.5, 1.5, 0x1p52, 0x1p51, -0x1.fffffffffffffp51}};
  all.push_back(unary("sign", sign, sign_of, {kLine}, focus));
  all.push_back(unary("ceil", ceil, ceil_of, {kLine}, focus));
  all.push_back(unary("floor", floor, floor_of, {kLine}, focus));
  all.push_back(unary("trunc", trunc, trunc_of, {kLine}, focus));
  all.push_back(unary("round_ties_to_even", round_ties_to_even, even_of, {kLine}, focus));
  all.push_back(unary("round_ties_to_away", round_ties_to_away, away_of, {kLine}, focus));
}

// ---- Integer powers and roots.

Monotone power(int n) {
  const At at = [n](double x) {
    Registers& r = Registers::of_thread();
    return r.bracket(mpfr_pow_si(r.result(), r.set(0, x), n, MPFR_RNDD));
  };
  const Focus wide{-30.0, 30.0, {-1.0, 1.0, 0x1p-512, 0x1p511}}, near_one{-1.5, 1.5, {-1.0, 1.0}};
  return {at, {kNegative, kPositive}, std::abs(static_cast<double>(n)) > 100 ? near_one : wide};
}

Monotone root(int n) {
  const At at = [n](double x) {
    Registers& r = Registers::of_thread();
    return r.bracket(mpfr_rootn_si(r.result(), r.set(0, x), n, MPFR_RNDD));
  };
  return {at,
          n % 2 == 0 ? std::vector<Piece>{kPositive} : std::vector<Piece>{kNegative, kPositive},
          {-1000.0, 1000.0, {-1.0, 1.0, 8.0, 1024.0}}};
}

constexpr auto kRoots = [] {
  auto roots = kExponents;
  for (int& n : roots) n = n == 0 ? 6 : n;
  return roots;
}();

using Order = Interval (*)(const Interval&, int);

template <std::size_t kCount>
Operation by_exponent(std::string name, Order f, const std::array<int, kCount>& exponents,
                      Monotone (*meaning)(int)) {
  return {std::move(name),
          1,
          Promise::tightest,
          kCount,
          [f, &exponents](const Arguments& a, std::size_t k) {
            return Outcome{f(a[0], exponents[k]), {}};
          },
          [meaning, &exponents](Draw& draw, std::size_t k) {
            return monotone_source(meaning(exponents[k]), kPool / kCount, draw);
          }};
}

// ---- Arithmetic, case by case.

Bracket product(double x, double y) {
  if (x == 0 || y == 0) return {0.0, 0.0};  // infinity is a bound and no value
  return bracket_of(mpfr_mul, x, y);
}

template <class Point>
Interval corners(const Interval& a, const Interval& b, Point f) {
  Hull hull;
  for (const double x : {a.lo(), a.hi()}) {
    for (const double y : {b.lo(), b.hi()}) hull.add(f(x, y));
  }
  return hull.interval();
}

bool is_any_empty(const Interval& a, const Interval& b) { return a.is_empty() || b.is_empty(); }

Interval exact_sum(const Interval& a, const Interval& b, Binary f) {
  if (is_any_empty(a, b)) return Interval::empty();
  const bool minus = f == static_cast<Binary>(mpfr_sub);
  return Interval::raw(bracket_of(f, a.lo(), minus ? b.hi() : b.lo()).lo,
                       bracket_of(f, a.hi(), minus ? b.lo() : b.hi()).hi);
}

/// The divisor's parts on either side of 0; at 0 MPFR gives the limit for the sign of the zero, and NaN for
/// 0/0 and oo/oo, whose limits the other corners have.
Interval exact_quotient(const Interval& a, const Interval& b) {
  if (is_any_empty(a, b)) return Interval::empty();
  Hull hull;
  const auto f = [](double x, double y) { return x == 0 && y == 0 ? Bracket{} : bracket_of(mpfr_div, x, y); };
  const auto add = [&](const Interval& part) {
    const Interval image = corners(a, part, f);
    if (!image.is_empty()) hull.add({image.lo(), image.hi()});
  };
  if (b.lo() < 0) add(Interval::raw(b.lo(), b.hi() >= 0 ? -0.0 : b.hi()));
  if (b.hi() > 0) add(Interval::raw(b.lo() <= 0 ? 0.0 : b.lo(), b.hi()));
  return hull.interval();
}

Interval exact_fma(const Arguments& in) {
  const auto& [a, b, c] = in;
  if (is_any_empty(a, b) || c.is_empty()) return Interval::empty();
  double lo = kInfinity, hi = -kInfinity;
  for (const double x : {a.lo(), a.hi()}) {
    for (const double y : {b.lo(), b.hi()}) {
      const bool none = x == 0 || y == 0;  // then the product is 0, and c the sum
      // An infinite bound of c is the sum's, whatever the product; nor can NaN come of it.
      lo = std::min(lo, none || std::isinf(c.lo()) ? c.lo() : bracket_of_fma(x, y, c.lo()).lo);
      hi = std::max(hi, none || std::isinf(c.hi()) ? c.hi() : bracket_of_fma(x, y, c.hi()).hi);
    }
  }
  return Interval::raw(lo, hi);
}

/// Whether a is at least as wide as b: the sign of a sum of four, which MPFR rounds correctly.
bool is_as_wide(const Interval& a, const Interval& b) {
  mpfr_t terms[4], sum;
  mpfr_ptr pointers[4];
  const double values[] = {a.hi(), -a.lo(), -b.hi(), b.lo()};
  for (int k = 0; k < 4; ++k) {
    mpfr_init2(terms[k], 53);
    mpfr_set_d(terms[k], values[k], MPFR_RNDN);
    pointers[k] = terms[k];
  }
  mpfr_init2(sum, 53);
  mpfr_sum(sum, pointers, 4, MPFR_RNDN);
  const bool result = mpfr_sgn(sum) >= 0;
  for (mpfr_t& term : terms) mpfr_clear(term);
  mpfr_clear(sum);
  return result;
}

Interval exact_cancel_minus(const Interval& a, const Interval& b) {
  const auto is_unbounded = [](const Interval& x) { return !x.is_empty() && !x.is_bounded(); };
  if (is_unbounded(a) || is_unbounded(b)) return Interval::entire();
  if (a.is_empty()) return Interval::empty();
  if (b.is_empty() || !is_as_wide(a, b)) return Interval::entire();
  return Interval::raw(bracket_of(mpfr_sub, a.lo(), b.lo()).lo, bracket_of(mpfr_sub, a.hi(), b.hi()).hi);
}

Interval exact_extreme(const Interval& a, const Interval& b, Binary f) {
  if (is_any_empty(a, b)) return Interval::empty();
  return Interval::raw(bracket_of(f, a.lo(), b.lo()).lo, bracket_of(f, a.hi(), b.hi()).hi);
}

Operation binary(std::string name, TwoArguments f, TwoArguments exact, Binary at = nullptr) {
  Direct meaning{2, [exact](const Arguments& a) { return exact(a[0], a[1]); }, {}, {}};
  if (at != nullptr) meaning.at = [at](double x, double y, double) { return bracket_of(at, x, y); };
  return {std::move(name),
          2,
          Promise::tightest,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{f(a[0], a[1]), {}};
          },
          [meaning](Draw& draw, std::size_t) { return direct_source(meaning, draw); }};
}

Operation ternary_fma() {
  const Direct meaning{3, exact_fma, bracket_of_fma, {}};
  return {"fma",
          3,
          Promise::tightest,
          1,
          [](const Arguments& a, std::size_t) {
            return Outcome{fma(a[0], a[1], a[2]), {}};
          },
          [meaning](Draw& draw, std::size_t) { return direct_source(meaning, draw); }};
}

using I = const Interval&;

void add_arithmetic(std::vector<Operation>& all) {
  all.push_back(unary("neg", [](I a) { return -a; }, minus, {kLine}));
  all.push_back(unary("abs", abs, magnitude, {kNegative, kPositive}));
  all.push_back(unary("sqr", sqr, mpfr_sqr, {kNegative, kPositive},
                      {-10.0, 10.0, {0x1p-537, 0x1p-511, 0x1p511, 0x1p512}}));
  all.push_back(unary("sqrt", sqrt, mpfr_sqrt, {{0.0, kInfinity}}, {0.0, 100.0, {0x1p-1022}}));
  all.push_back(unary("recip", recip, recip_of, {kNegative, kPositive},
                      {-10.0, 10.0, {0x1p-1024, 0x1p1022, 0x1p-1022}}));
  all.push_back(binary(
      "add", [](I a, I b) { return a + b; }, [](I a, I b) { return exact_sum(a, b, mpfr_add); }, mpfr_add));
  all.push_back(binary(
      "sub", [](I a, I b) { return a - b; }, [](I a, I b) { return exact_sum(a, b, mpfr_sub); }, mpfr_sub));
  all.push_back(binary(
      "mul", [](I a, I b) { return a * b; },
      [](I a, I b) { return is_any_empty(a, b) ? Interval::empty() : corners(a, b, product); }, mpfr_mul));
  all.push_back(binary(
      "div", [](I a, I b) { return a / b; }, exact_quotient, mpfr_div));
  all.push_back(ternary_fma());
  all.push_back(binary(
      "min", min, [](I a, I b) { return exact_extreme(a, b, mpfr_min); }, mpfr_min));
  all.push_back(binary(
      "max", max, [](I a, I b) { return exact_extreme(a, b, mpfr_max); }, mpfr_max));
  all.push_back(binary("cancel_minus", cancel_minus, exact_cancel_minus));
  all.push_back(binary("cancel_plus", cancel_plus, [](I a, I b) { return exact_cancel_minus(a, -b); }));
}

// ---- Surfaces.

Operation surface(std::string name, TwoArguments f, Surface meaning) {
  return {std::move(name),
          2,
          Promise::tightest,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{f(a[0], a[1]), {}};
          },
          [meaning](Draw& draw, std::size_t) { return surface_source(meaning, kSide, draw); }};
}

Operation surface_reverse(std::string name, ThreeArguments f, Surface meaning, Contracts contracts) {
  return {std::move(name),
          3,
          Promise::part_of_last,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{f(a[0], a[1], a[2]), {}};
          },
          [meaning, contracts](Draw& draw, std::size_t) {
            return surface_reverse_source(meaning, contracts, kSide, draw);
          }};
}

Operation angle_reverse() {
  return {"atan2_rev",
          3,
          Promise::each,
          1,
          [](const Arguments& a, std::size_t) {
            Outcome result{a[1], a[2]};
            if (!atan2_rev(a[0], result[0], result[1])) result = {Interval::empty(), Interval::empty()};
            return result;
          },
          [](Draw& draw, std::size_t) {
            return surface_reverse_source(Surface::atan2, Contracts::both, kSide, draw);
          }};
}

void add_surfaces(std::vector<Operation>& all) {
  all.push_back(surface("atan2", atan2, Surface::atan2));
  all.push_back(surface("pow", pow, Surface::pow));
  all.push_back(surface_reverse("atan2_rev1", atan2_rev1, Surface::atan2, Contracts::first));
  all.push_back(surface_reverse("atan2_rev2", atan2_rev2, Surface::atan2, Contracts::second));
  all.push_back(surface_reverse("pow_rev1", pow_rev1, Surface::pow, Contracts::first));
  all.push_back(surface_reverse("pow_rev2", pow_rev2, Surface::pow, Contracts::second));
  all.push_back(angle_reverse());
}

// ---- Reverse operations.

Operation reverse(std::string name, TwoArguments f, const At& at, const Focus& focus = {}) {
  const Monotone meaning{at, {}, focus};
  return {std::move(name),
          2,
          Promise::part_of_last,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{f(a[0], a[1]), {}};
          },
          [meaning](Draw& draw, std::size_t) { return reverse_source(meaning, kPool, draw); }};
}

Operation power_reverse() {
  return {"pown_rev",
          2,
          Promise::part_of_last,
          kExponents.size(),
          [](const Arguments& a, std::size_t k) {
            return Outcome{pown_rev(a[0], a[1], kExponents[k]), {}};
          },
          [](Draw& draw, std::size_t k) {
            return reverse_source(power(kExponents[k]), kPool / kExponents.size(), draw);
          }};
}

Operation product_reverse() {
  return {"mul_rev",
          3,
          Promise::part_of_last,
          1,
          [](const Arguments& a, std::size_t) {
            return Outcome{mul_rev(a[0], a[1], a[2]), {}};
          },
          [](Draw& draw, std::size_t) { return direct_reverse_source(product, true, draw); }};
}

Operation product_reverse_to_pair() {
  return {"mul_rev_to_pair",
          2,
          Promise::either,
          1,
          [](const Arguments& a, std::size_t) { return mul_rev_to_pair(a[0], a[1]); },
          [](Draw& draw, std::size_t) { return direct_reverse_source(product, false, draw); }};
}

void add_reverses(std::vector<Operation>& all) {
  const Focus turns{-25.0, 25.0, {0x1.921fb54442d18p+0, 0x1.921fb54442d18p+1, 0x1p26, 0x1p30}};
  all.push_back(reverse("sqr_rev", sqr_rev, by(mpfr_sqr)));
  all.push_back(reverse("abs_rev", abs_rev, by(magnitude)));
  all.push_back(reverse("sin_rev", sin_rev, by(mpfr_sin), turns));
  all.push_back(reverse("cos_rev", cos_rev, by(mpfr_cos), turns));
  all.push_back(reverse("tan_rev", tan_rev, by(mpfr_tan), turns));
  all.push_back(reverse("cosh_rev", cosh_rev, by(mpfr_cosh), {-715.0, 715.0, {0.0, 1.0}}));
  all.push_back(power_reverse());
  all.push_back(product_reverse());
  all.push_back(product_reverse_to_pair());
}

}  // namespace

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all = [] {
    std::vector<Operation> result;
    add_arithmetic(result);
    add_exponentials(result);
    add_circular(result);
    add_steps(result);
    result.push_back(by_exponent("pown", pown, kExponents, power));
    result.push_back(by_exponent("rootn", rootn, kRoots, root));
    add_surfaces(result);
    add_reverses(result);
    for (Operation& operation : result) {
      const bool has_one = operation.promise == Promise::part_of_last || operation.promise == Promise::either;
      if (has_one && operation.name != "abs_rev")
        operation = with_witnesses(operation, kWitnesses / operation.variants);
    }
    add_numbers(result);
    return result;
  }();
  return all;
}

}  // namespace hcsp::campaign
