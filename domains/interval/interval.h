// SPDX-License-Identifier: Apache-2.0
// Closed real intervals in the set-based flavour of IEEE 1788-2015: the sets of reals {x : lo <= x <= hi},
// bounds possibly infinite, and the empty set. Every function here is sound in any rounding mode of the
// caller, which is left as found; the engine's inner loops use the kernels of interval/kernel.h under one
// guard instead.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "domains/lattice.h"

namespace hcsp {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Two doubles in one register: the bounds (-lo, hi) of an interval. With the lower bound negated both round
/// upward, join is a maximum, inclusion a comparison, and negation swaps the two (Lambov 2008).
using Bounds [[gnu::vector_size(16)]] = double;

/// Whether both comparisons of a vector hold.
template <class Mask>
inline bool both(const Mask& mask) {
  return (mask[0] & mask[1]) != 0;
}
inline Bounds swapped(const Bounds& b) { return __builtin_shufflevector(b, b, 1, 0); }
/// The lesser and the greater of two, lane by lane; where one is NaN, y.
inline Bounds least(const Bounds& x, const Bounds& y) { return x < y ? x : y; }
inline Bounds greatest(const Bounds& x, const Bounds& y) { return x > y ? x : y; }

class Interval {
 public:
  using Delta = ChangedDelta;

  /// The whole real line.
  constexpr Interval() : bounds_{kInfinity, kInfinity} {}
  /// The point x. Throws std::invalid_argument unless x is finite.
  Interval(double x);  // NOLINT(google-explicit-constructor): a double is a point
  /// [lo, hi]. Throws std::invalid_argument on NaN, lo > hi, lo == +oo or hi == -oo.
  Interval(double lo, double hi);

  static constexpr Interval raw(double lo, double hi) { return Interval(Unchecked{}, lo, hi); }
  static Interval of_bounds(const Bounds& bounds) {
    Interval a;
    a.bounds_ = bounds;
    return a;
  }
  static constexpr Interval entire() { return {}; }
  static constexpr Interval empty() { return raw(kInfinity, -kInfinity); }
  /// The tightest interval around the decimal (or hexadecimal, or "oo"-signed infinite bound) number written
  /// in text. "0.1" gives the two doubles around one tenth. Throws std::invalid_argument when text is not a
  /// number.
  static Interval of_decimal(std::string_view text);
  /// A literal of IEEE 1788-2015, 9.7 and 12.11, without decoration: "[0.1, 2/3]", "[1.5]", "[, 2]",
  /// "[entire]",
  /// "[empty]", "3.56?1", "-10?u", "0x1.8p1"; each bound is rounded outwards. Throws std::invalid_argument
  /// when it is none.
  static Interval of_text(std::string_view text);
  /// The tightest interval around mantissa * 10^exponent.
  static Interval of_decimal(std::int64_t mantissa, int exponent);

  [[nodiscard]] double lo() const { return -bounds_[0]; }
  [[nodiscard]] double hi() const { return bounds_[1]; }
  /// (-lo, hi).
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  [[nodiscard]] bool is_empty() const { return !(lo() <= hi()); }
  [[nodiscard]] bool is_point() const { return lo() == hi(); }
  [[nodiscard]] bool is_entire() const { return both(bounds_ == kInfinity); }
  [[nodiscard]] bool is_bounded() const { return both(bounds_ < kInfinity); }
  [[nodiscard]] bool contains(double x) const { return both(Bounds{-x, x} <= bounds_); }
  /// The width, rounded up; 0 for the empty set.
  [[nodiscard]] double width() const;
  /// A finite double inside, the nearest to the midpoint where the interval is bounded. Not for the empty
  /// set.
  [[nodiscard]] double mid() const;
  /// The largest absolute value; 0 for the empty set.
  [[nodiscard]] double mag() const;

  /// Equal as sets.
  friend bool operator==(const Interval& a, const Interval& b) {
    return both(a.bounds_ == b.bounds_) || (a.is_empty() && b.is_empty());
  }

 private:
  struct Unchecked {};
  constexpr Interval(Unchecked, double lo, double hi) : bounds_{-lo, hi} {}
  Bounds bounds_;
};

// The lattice of intervals, ordered by inclusion. Comparisons only: no rounding is involved. They see
// denormals as the thread does: where the caller may have set denormals-are-zero, take intersection and
// convex_hull (functions.h), subset, equal and is_member (numeric.h), or hold a guard of rounding.h.
inline Interval meet(const Interval& a, const Interval& b) {
  const Bounds met = least(a.bounds(), b.bounds());
  return Interval::of_bounds(-swapped(met) > met ? Interval::empty().bounds() : met);
}
/// The empty set is [+oo, -oo], neutral for the minimum of the lower and the maximum of the upper bounds.
inline Interval join(const Interval& a, const Interval& b) {
  return Interval::of_bounds(greatest(a.bounds(), b.bounds()));
}
inline bool leq(const Interval& a, const Interval& b) {
  return both(a.bounds() <= b.bounds()) || a.is_empty();
}
inline Interval top(const Interval&) { return Interval::entire(); }
inline Interval bottom(const Interval&) { return Interval::empty(); }
inline Interval::Delta contract(Interval& a, const Interval& b) {
  const Interval met = meet(a, b);
  const bool changed = !(met == a);
  a = met;
  return {changed};
}
inline Interval::Delta everything(const Interval&) { return {true}; }
/// How much a domain leaves open, for reports: its width.
inline double measure(const Interval& a) { return a.width(); }

// Forward operations (IEEE 1788-2015, 9.1): enclosures of the image, tightest for every operation below.
// Arguments outside an operation's domain of definition are ignored: sqrt([-1, 4]) = [0, 2].
inline Interval operator-(const Interval& a) { return Interval::of_bounds(swapped(a.bounds())); }
Interval operator+(const Interval& a, const Interval& b);
Interval operator-(const Interval& a, const Interval& b);
Interval operator*(const Interval& a, const Interval& b);
Interval operator/(const Interval& a, const Interval& b);
inline Interval& operator+=(Interval& a, const Interval& b) { return a = a + b; }
inline Interval& operator-=(Interval& a, const Interval& b) { return a = a - b; }
inline Interval& operator*=(Interval& a, const Interval& b) { return a = a * b; }
inline Interval& operator/=(Interval& a, const Interval& b) { return a = a / b; }
Interval sqr(const Interval& a);
Interval sqrt(const Interval& a);
Interval abs(const Interval& a);
Interval min(const Interval& a, const Interval& b);
Interval max(const Interval& a, const Interval& b);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
/// The angle of the vector (x, y), in [-pi, pi], in the argument order of IEEE 1788; undefined at (0, 0).
Interval atan2(const Interval& y, const Interval& x);
/// The tightest enclosure of pi.
Interval pi();

/// "[lo, hi]" in shortest round-trip form, "[empty]" for the empty set.
std::string to_string(const Interval& a);

static_assert(Lattice<Interval>);

}  // namespace hcsp
