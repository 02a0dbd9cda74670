// SPDX-License-Identifier: Apache-2.0
// Sources of atan2 and pow, evaluated on a grid: every box between its lines is a case.
#include <algorithm>
#include <cmath>

#include "tests/soundness/interval_sources.h"

namespace hcsp::campaign {

namespace {

Focus focus_of(Surface surface, bool first) {
  if (surface == Surface::atan2) return {-4.0, 4.0, {-1.0, 1.0, 0x1p-1074, 0x1p1023}};
  if (first) return {0.0, 8.0, {0.5, 1.0, 2.0, 0x1p-1074}};
  return {-300.0, 300.0, {-1.0, 0.5, 1.0, 2.0, 3.0}};
}

/// z = f(first, second) at all pairs of two pools; atan2 is taken of (y, x), pow of (base, exponent).
class Grid {
 public:
  Grid(Surface surface, std::size_t side, Draw& draw)
      : surface_(surface),
        first_(side, focus_of(surface, true), draw),
        second_(side, focus_of(surface, false), draw) {
    values_.reserve(first_.size() * second_.size());
    for (std::size_t i = 0; i < first_.size(); ++i) {
      for (std::size_t j = 0; j < second_.size(); ++j) values_.push_back(corner(first_[i], second_[j]));
    }
    if (surface == Surface::pow) return;
    for (std::size_t j = 0; j < second_.size(); ++j) below_.push_back(corner(-0.0, second_[j]));
  }

  [[nodiscard]] const Pool& first() const { return first_; }
  [[nodiscard]] const Pool& second() const { return second_; }

  /// The limit from within a box at its corner, possibly infinite; at infinity MPFR, as C, gives that limit,
  /// and so it does at 0.
  [[nodiscard]] const Bracket& limit(std::size_t i, std::size_t j) const {
    return values_[i * second_.size() + j];
  }
  /// The limit of the angle at (x, y) for y -> 0 from below.
  [[nodiscard]] const Bracket& limit_below(std::size_t j) const { return below_[j]; }

  /// The value itself; none where there is none.
  [[nodiscard]] Bracket value(std::size_t i, std::size_t j) const {
    const bool defined = surface_ == Surface::atan2 || first_[i] > 0 || (first_[i] == 0 && second_[j] > 0);
    return defined ? limit(i, j) : Bracket{};
  }

 private:
  [[nodiscard]] Bracket corner(double a, double b) const {
    if (surface_ == Surface::pow) return a < 0 ? Bracket{} : bracket_of(mpfr_pow, a, b);
    return a == 0 && b == 0 ? Bracket{} : bracket_of(mpfr_atan2, a, b);
  }

  Surface surface_;
  Pool first_, second_;
  std::vector<Bracket> values_, below_;
};

/// A part of a box on which the function is monotone in each variable, so that it lies between its corners.
void add_corners(const Grid& grid, const Span& a, const Span& b, Hull& hull) {
  for (const std::size_t i : {a.first, a.last}) {
    for (const std::size_t j : {b.first, b.last}) hull.add(grid.limit(i, j));
  }
}

/// The angles: those of the upper half plane with the axis, in which the angle of (x, y) falls with x and is
/// monotone in y on either side of x = 0; then those of the lower half plane without.
Interval angles(const Grid& grid, const Span& y, const Span& x) {
  const std::size_t y_axis = grid.first().zero(), x_axis = grid.second().zero();
  Hull hull;
  for (const bool left : {false, true}) {
    const Span part =
        left ? Span{x.first, std::min(x.last, x_axis)} : Span{std::max(x.first, x_axis), x.last};
    if (part.is_empty()) continue;
    if (y.last >= y_axis) add_corners(grid, {std::max(y.first, y_axis), y.last}, part, hull);
    if (y.first >= y_axis) continue;
    const std::size_t top = std::min(y.last, y_axis);
    for (const std::size_t j : {part.first, part.last}) {
      hull.add(grid.limit(y.first, j));
      hull.add(top == y_axis ? grid.limit_below(j) : grid.limit(top, j));
    }
  }
  return hull.interval();
}

/// exp(b log a): the exponent is bilinear, so that its extremes are at corners; 0^b is 0 for b > 0, nothing
/// else.
Interval powers(const Grid& grid, const Span& a, const Span& b) {
  const std::size_t zero = grid.first().zero();
  Hull hull;
  if (a.last < zero) return hull.interval();
  if (a.last > zero) add_corners(grid, {std::max(a.first, zero), a.last}, b, hull);
  if (a.first <= zero && b.last > grid.second().zero()) hull.add({0.0, 0.0});
  return hull.interval();
}

class SurfaceSource final : public Source {
 public:
  SurfaceSource(Surface surface, std::size_t side, Draw& draw)
      : surface_(surface), grid_(surface, side, draw) {}

  Case next(Draw& draw) override {
    const Span a = grid_.first().span(draw), b = grid_.second().span(draw);
    Case result;
    result.in[0] = grid_.first().interval(a);
    result.in[1] = grid_.second().interval(b);
    if (a.is_empty() || b.is_empty()) {
      result.exact = Interval::empty();
      return result;
    }
    result.exact = surface_ == Surface::atan2 ? angles(grid_, a, b) : powers(grid_, a, b);
    for (int k = 0; k < 2; ++k) {
      result.must_hold(grid_.value(grid_.first().pick(a, draw), grid_.second().pick(b, draw)));
    }
    return result;
  }

 private:
  Surface surface_;
  Grid grid_;
};

class SurfaceReverseSource final : public Source {
 public:
  SurfaceReverseSource(Surface surface, Contracts contracts, std::size_t side, Draw& draw)
      : contracts_(contracts), grid_(surface, side, draw) {}

  Case next(Draw& draw) override {
    const Span a = grid_.first().span(draw), b = grid_.second().span(draw);
    const Interval first = grid_.first().interval(a), second = grid_.second().interval(b);
    const bool some = !a.is_empty() && !b.is_empty();
    const std::size_t i = some ? grid_.first().pick(a, draw) : 1, j = some ? grid_.second().pick(b, draw) : 1;
    const Bracket value = grid_.value(i, j), other = grid_.value(1 + draw.below(grid_.first().size() - 2), j);
    const Interval c = around(value, other, draw);
    Case result = arranged(first, second, c);
    if (!some || !is_reached(value, c)) return result;
    const double x = grid_.first()[i], y = grid_.second()[j];
    if (contracts_ != Contracts::second) result.must_hold({x, x});
    if (contracts_ != Contracts::first) result.must_hold({y, y});
    return result;
  }

 private:
  /// The other argument, the value, then the one to contract; or the value, then both.
  [[nodiscard]] Case arranged(const Interval& first, const Interval& second, const Interval& c) const {
    Case result;
    if (contracts_ == Contracts::both) {
      result.in = {c, first, second};
    } else if (contracts_ == Contracts::first) {
      result.in = {second, c, first};
    } else {
      result.in = {first, c, second};
    }
    return result;
  }

  Contracts contracts_;
  Grid grid_;
};

}  // namespace

std::unique_ptr<Source> surface_source(Surface surface, std::size_t side, Draw& draw) {
  return std::make_unique<SurfaceSource>(surface, side, draw);
}
std::unique_ptr<Source> surface_reverse_source(Surface surface, Contracts contracts, std::size_t side,
                                               Draw& draw) {
  return std::make_unique<SurfaceReverseSource>(surface, contracts, side, draw);
}

}  // namespace hcsp::campaign
