// SPDX-License-Identifier: Apache-2.0
// The reverses of sin, cos, tan and atan2: the part of the arguments that can give a value. Built of tightest
// point functions and outward rounded operations, all monotone, so that they are inclusion-isotone.
#include <algorithm>
#include <cmath>

#include "domains/interval/arcs.h"
#include "domains/interval/guarded.h"
#include "domains/interval/kernel.h"
#include "domains/interval/reverse.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

/// The doubles around a value that is known within 2^-63 relative.
Interval around(DoubleDouble value) {
  const double error = 0x1p-63 * std::abs(value.hi);
  return Interval::raw(value.lo > error ? value.hi : up::next_down(value.hi),
                       value.lo < -error ? value.hi : up::next_up(value.hi));
}

/// The arguments of a periodic function whose values lie in c, as a union of branches: [first, last] + n pi
/// for even n, and for odd n the mirrored m pi - [last, first] with m = n or n + 1, or for the tangent the
/// same as for even n; each rounded outwards. Beyond kFarthest every argument counts, so that this is one
/// fixed set for one c, and growing with c: its hull within x is inclusion-isotone in both.
class Branches {
 public:
  enum class Odd : std::uint8_t { mirrored_at_n, mirrored_at_next, same };
  Branches(DoubleDouble first, DoubleDouble last, Odd odd) : first_(first), last_(last), odd_(odd) {}

  /// The hull of the union within x. PRECONDITION: round to nearest.
  [[nodiscard]] Interval within(const Interval& x) const {
    return meet(x, Interval::raw(first_from(x.lo()), last_to(x.hi())));
  }

 private:
  static constexpr double kFarthest = 0x1p30;  // any value is sound; the branches' numbers must fit an int

  [[nodiscard]] Interval branch(int n) const {
    const bool mirrored = n % 2 != 0 && odd_ != Odd::same;
    const DoubleDouble centre = multiply(kPi, mirrored && odd_ == Odd::mirrored_at_next ? n + 1.0 : n);
    const DoubleDouble lo = mirrored ? negate(last_) : first_, hi = mirrored ? negate(first_) : last_;
    return Interval::raw(at(centre, lo).lo(), at(centre, hi).hi());
  }

  // centre + offset, of which the greater comes first; 0 is no approximation.
  static Interval at(DoubleDouble centre, DoubleDouble offset) {
    if (centre.hi == 0 && offset.hi == 0) return Interval::raw(0.0, 0.0);
    return around(centre.hi == 0 ? offset : add(centre, offset));
  }

  /// Two less than the number of the branch around x, give or take one: what is before it, or five on, cannot
  /// matter.
  static int number_before(double x) { return static_cast<int>(std::floor(x / kPiBounds.lo())) - 2; }

  [[nodiscard]] double first_from(double x) const {
    if (!(std::abs(x) <= kFarthest)) return x;
    double first = kFarthest;
    const int start = number_before(x);
    for (int n = start; n < start + 5; ++n) {
      const Interval b = branch(n);
      if (b.hi() >= x) first = std::min(first, std::max(b.lo(), x));
    }
    return first;
  }

  [[nodiscard]] double last_to(double x) const {
    if (!(std::abs(x) <= kFarthest)) return x;
    double last = -kFarthest;
    const int start = number_before(x);
    for (int n = start; n < start + 5; ++n) {
      const Interval b = branch(n);
      if (b.lo() <= x) last = std::max(last, std::min(b.hi(), x));
    }
    return last;
  }

  DoubleDouble first_, last_;
  Odd odd_;
};

Interval wave_rev(const Interval& c, const Interval& x, bool cosine) {
  RoundNearest guard;
  const Interval range = meet(opaque_bounds(c), kUnit), argument = opaque_bounds(x);
  if (range.is_empty() || argument.is_empty()) return Interval::empty();
  if (range == kUnit) return argument;
  const Branches branches =
      cosine ? Branches(arccosine(range.hi()), arccosine(range.lo()), Branches::Odd::mirrored_at_next)
             : Branches(arcsine(range.lo()), arcsine(range.hi()), Branches::Odd::mirrored_at_n);
  return opaque_bounds(branches.within(argument));
}

/// The part of the box (x, y) of the first quadrant at an angle in [lo, hi], as its hull. PRECONDITION:
/// upward rounding.
struct Sector {
  Interval x, y;

  /// The axes belong to the quadrant; the origin alone has no angle.
  [[nodiscard]] bool is_empty() const { return x.is_empty() || y.is_empty() || (x.hi() == 0 && y.hi() == 0); }

  void contract(const Interval& angle) {
    const bool from_axis = angle.lo() <= 0, to_axis = angle.hi() >= kHalfPiBounds.hi();
    const double lo = from_axis ? 0.0 : angle.lo(), hi = to_axis ? kHalfPiBounds.lo() : angle.hi();
    const Interval sin_lo = sin(Interval::raw(lo, lo)), cos_lo = cos(Interval::raw(lo, lo));
    const Interval sin_hi = sin(Interval::raw(hi, hi)), cos_hi = cos(Interval::raw(hi, hi));
    // tan and cot at the edges; each rounding is monotone, so that a wider angle never contracts more.
    const double y_lo = up::mul_down(x.lo(), up::div_down(sin_lo.lo(), cos_lo.hi()));
    const double y_hi = to_axis ? kInfinity : up::zero_for_nan(x.hi() * (sin_hi.hi() / cos_hi.lo()));
    const double x_lo =
        to_axis ? 0.0 : up::zero_for_nan(up::mul_down(y.lo(), up::div_down(cos_hi.lo(), sin_hi.hi())));
    const double x_hi = from_axis ? kInfinity : up::zero_for_nan(y.hi() * (cos_lo.hi() / sin_lo.lo()));
    x = meet(x, Interval::raw(x_lo, x_hi));
    y = meet(y, Interval::raw(y_lo, y_hi));
  }
};

/// One quadrant's part of atan2_rev, mirrored into the first quadrant and back.
void join_quadrant(const Interval& angle, bool left, bool lower, const Interval& y, const Interval& x,
                   Sector& hull) {
  const Interval positive = Interval::raw(0.0, kInfinity);
  Interval first = angle;
  if (left)
    first = lower ? up::add(angle, kPiBounds) : up::sub(kPiBounds, angle);
  else if (lower)
    first = -angle;
  if (first.hi() < 0 || first.lo() > kHalfPiBounds.lo()) return;
  Sector part{meet(left ? -x : x, positive), meet(lower ? -y : y, positive)};
  if (part.is_empty() || (lower && part.y.hi() == 0)) return;  // y = 0 belongs to the upper quadrants
  part.contract(first);
  if (part.is_empty()) return;
  hull.x = join(hull.x, left ? -part.x : part.x);
  hull.y = join(hull.y, lower ? -part.y : part.y);
}

}  // namespace

Interval sin_rev(const Interval& c, const Interval& x) { return wave_rev(c, x, false); }
Interval cos_rev(const Interval& c, const Interval& x) { return wave_rev(c, x, true); }

Interval tan_rev(const Interval& c, const Interval& x) {
  RoundNearest guard;
  const Interval range = opaque_bounds(c), argument = opaque_bounds(x);
  if (range.is_empty() || argument.is_empty()) return Interval::empty();
  const Branches branches(arctangent(range.lo()), arctangent(range.hi()), Branches::Odd::same);
  return opaque_bounds(branches.within(argument));
}

bool atan2_rev(const Interval& angle, Interval& y, Interval& x) {
  RoundUpward guard;
  const Interval turn = opaque_bounds(angle), ordinate = opaque_bounds(y), abscissa = opaque_bounds(x);
  Sector hull{Interval::empty(), Interval::empty()};
  if (!turn.is_empty() && !ordinate.is_empty() && !abscissa.is_empty()) {
    for (const bool left : {false, true}) {
      for (const bool lower : {false, true}) join_quadrant(turn, left, lower, ordinate, abscissa, hull);
    }
  }
  x = opaque_bounds(hull.x);
  y = opaque_bounds(hull.y);
  return !x.is_empty();
}

}  // namespace hcsp
