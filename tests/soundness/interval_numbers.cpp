// SPDX-License-Identifier: Apache-2.0
// The operations of the campaign that give numbers or truth values, which are outcomes as points, NaN as the
// empty set; and the lattice's.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "domains/interval/functions.h"
#include "domains/interval/numeric.h"
#include "domains/interval/reverse.h"
#include "tests/soundness/interval_sources.h"

namespace hcsp::campaign {

namespace {

using I = const Interval&;

constexpr double kLargest = std::numeric_limits<double>::max();

/// Infinity, which no interval is, as what lies beyond the doubles.
Interval point(double x) {
  if (std::isnan(x)) return Interval::empty();
  if (x == -kInfinity) return Interval::raw(x, -kLargest);
  return x == kInfinity ? Interval::raw(kLargest, x) : Interval::raw(x, x);
}
Interval truth(bool x) { return point(x ? 1.0 : 0.0); }

// ---- Numbers.

/// (lo + hi) / 2 or hi - lo in enough bits for any two doubles, then rounded.
double rounded_sum(double a, double b, int halvings, mpfr_rnd_t direction) {
  mpfr_t sum;
  mpfr_init2(sum, 2200);
  mpfr_set_d(sum, a, MPFR_RNDN);
  mpfr_add_d(sum, sum, b, MPFR_RNDN);
  mpfr_div_2ui(sum, sum, static_cast<unsigned long>(halvings), MPFR_RNDN);
  const double result = mpfr_get_d(sum, direction);
  mpfr_clear(sum);
  return result;
}

double exact_mid(I a) {
  if (a.is_empty()) return NAN;
  if (a.is_entire()) return 0.0;
  if (!a.is_bounded()) return a.lo() == -kInfinity ? -kLargest : kLargest;
  return rounded_sum(a.lo(), a.hi(), 1, MPFR_RNDN);
}

double exact_wid(I a) { return a.is_empty() ? NAN : rounded_sum(a.hi(), -a.lo(), 0, MPFR_RNDU); }

double exact_rad(I a) {
  if (a.is_empty()) return NAN;
  const double m = exact_mid(a);
  return std::max(rounded_sum(m, -a.lo(), 0, MPFR_RNDU), rounded_sum(a.hi(), -m, 0, MPFR_RNDU));
}

double exact_mag(I a) { return a.is_empty() ? NAN : std::max(std::abs(a.lo()), std::abs(a.hi())); }
double exact_mig(I a) {
  if (a.is_empty()) return NAN;
  return a.contains(0.0) ? 0.0 : std::min(std::abs(a.lo()), std::abs(a.hi()));
}

double exact_inf(I a) { return a.lo(); }
double exact_sup(I a) { return a.hi(); }

Operation number(std::string name, double (*f)(I), double (*exact)(I)) {
  const Direct meaning{1, [exact](const Arguments& a) { return point(exact(a[0])); }, {}, {}};
  return {std::move(name),
          1,
          Promise::tightest,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{point(f(a[0])), {}};
          },
          [meaning](Draw& draw, std::size_t) { return direct_source(meaning, draw); }};
}

// ---- Truth values, by the definitions of IEEE 1788-2015, tables 9.3 and 10.3, on the order of bits.

/// The same order as the doubles', in which both zeros are 0.
std::int64_t rank(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : -(bits & INT64_MAX);
}

struct Ranks {
  explicit Ranks(I a) : lo(rank(a.lo())), hi(rank(a.hi())), empty(lo > hi) {}
  std::int64_t lo, hi;
  bool empty;
};

const std::int64_t kTop = rank(kInfinity);
bool is_below(std::int64_t a, std::int64_t b) { return a < b || (a == b && (a == kTop || a == -kTop)); }

bool exact_equal(const Ranks& a, const Ranks& b) {
  return (a.empty && b.empty) || (!a.empty && !b.empty && a.lo == b.lo && a.hi == b.hi);
}
bool exact_subset(const Ranks& a, const Ranks& b) {
  return a.empty || (!b.empty && b.lo <= a.lo && a.hi <= b.hi);
}
bool exact_interior(const Ranks& a, const Ranks& b) {
  return a.empty || (!b.empty && is_below(b.lo, a.lo) && is_below(a.hi, b.hi));
}
bool exact_less(const Ranks& a, const Ranks& b) {
  return (a.empty && b.empty) || (!a.empty && !b.empty && a.lo <= b.lo && a.hi <= b.hi);
}
bool exact_strict_less(const Ranks& a, const Ranks& b) {
  return (a.empty && b.empty) || (!a.empty && !b.empty && is_below(a.lo, b.lo) && is_below(a.hi, b.hi));
}
bool exact_precedes(const Ranks& a, const Ranks& b) { return a.empty || b.empty || a.hi <= b.lo; }
bool exact_strict_precedes(const Ranks& a, const Ranks& b) { return a.empty || b.empty || a.hi < b.lo; }
bool exact_disjoint(const Ranks& a, const Ranks& b) {
  return a.empty || b.empty || a.hi < b.lo || b.hi < a.lo;
}

Operation comparison(std::string name, bool (*f)(I, I), bool (*exact)(const Ranks&, const Ranks&)) {
  Direct meaning{2, [exact](const Arguments& a) { return truth(exact(Ranks(a[0]), Ranks(a[1]))); }, {}, {}};
  meaning.numbers = 100;  // few, so that bounds are often equal
  return {std::move(name),
          2,
          Promise::tightest,
          1,
          [f](const Arguments& a, std::size_t) {
            return Outcome{truth(f(a[0], a[1])), {}};
          },
          [meaning](Draw& draw, std::size_t) { return direct_source(meaning, draw); }};
}

// ---- The lattice, on the same order.

Interval exact_meet(I a, I b) {
  const Ranks x(a), y(b);
  if (exact_disjoint(x, y)) return Interval::empty();
  return Interval::raw(x.lo > y.lo ? a.lo() : b.lo(), x.hi < y.hi ? a.hi() : b.hi());
}

Interval exact_join(I a, I b) {
  const Ranks x(a), y(b);
  if (x.empty || y.empty) return x.empty ? b : a;
  return Interval::raw(x.lo < y.lo ? a.lo() : b.lo(), x.hi > y.hi ? a.hi() : b.hi());
}

Operation lattice(std::string name, Interval (*f)(I, I), Interval (*exact)(I, I), bool flushes) {
  const Direct meaning{2, [exact](const Arguments& a) { return exact(a[0], a[1]); }, {}, {}};
  Operation result{std::move(name),
                   2,
                   Promise::tightest,
                   1,
                   [f](const Arguments& a, std::size_t) {
                     return Outcome{f(a[0], a[1]), {}};
                   },
                   [meaning](Draw& draw, std::size_t) { return direct_source(meaning, draw); }};
  result.flushes = flushes;
  return result;
}

}  // namespace

void add_numbers(std::vector<Operation>& all) {
  all.push_back(number("inf", inf, exact_inf));
  all.push_back(number("sup", sup, exact_sup));
  all.push_back(number("mid", mid, exact_mid));
  all.push_back(number("wid", wid, exact_wid));
  all.push_back(number("rad", rad, exact_rad));
  all.push_back(number("mag", mag, exact_mag));
  all.push_back(number("mig", mig, exact_mig));
  all.push_back(comparison("equal", equal, exact_equal));
  all.push_back(comparison("subset", subset, exact_subset));
  all.push_back(comparison("interior", interior, exact_interior));
  all.push_back(comparison("less", less, exact_less));
  all.push_back(comparison("strict_less", strict_less, exact_strict_less));
  all.push_back(comparison("precedes", precedes, exact_precedes));
  all.push_back(comparison("strict_precedes", strict_precedes, exact_strict_precedes));
  all.push_back(comparison("disjoint", disjoint, exact_disjoint));
  all.push_back(lattice("meet", meet, exact_meet, false));
  all.push_back(lattice("join", join, exact_join, false));
  all.push_back(lattice("intersection", intersection, exact_meet, true));
  all.push_back(lattice("convex_hull", convex_hull, exact_join, true));
}

}  // namespace hcsp::campaign
