// SPDX-License-Identifier: Apache-2.0
// Sources of functions of one variable, and of those whose image is cheap enough to be computed case by case.
#include "tests/soundness/interval_sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hcsp::campaign {

Interval around(const Bracket& value, const Bracket& other, Draw& draw) {
  Hull hull;
  hull.add(value);
  if (!value.exists() || !value.is_finite())
    return other.is_finite() ? Interval::raw(other.lo, other.hi) : Interval{};
  const Interval tightest = hull.interval();
  switch (draw.below(12)) {
    case 0:
      return draw.below(4) == 0 ? Interval::empty() : Interval::entire();
    case 1:
      return Interval::raw(-kInfinity, tightest.hi());
    case 2:
      return Interval::raw(tightest.lo(), kInfinity);
    case 3:
    case 4:
      return Interval::raw(step(tightest.lo(), -1 - static_cast<int>(draw.below(3))),
                           step(tightest.hi(), static_cast<int>(draw.below(3))));
    case 5:
    case 6:
    case 7:
      if (!other.is_finite()) return tightest;
      hull.add(other);
      return hull.interval();
    default:
      return tightest;
  }
}

namespace {

const Bracket kNone{};

/// A pool with the function's value at each number.
class Values {
 public:
  Values(const At& at, std::size_t size, const Focus& focus, Draw& draw) : pool_(size, focus, draw) {
    values_.reserve(pool_.size());
    for (std::size_t k = 0; k < pool_.size(); ++k) values_.push_back(at(pool_[k]));
  }
  [[nodiscard]] const Pool& pool() const { return pool_; }
  [[nodiscard]] const Bracket& operator[](std::size_t k) const { return values_[k]; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }

 private:
  Pool pool_;
  std::vector<Bracket> values_;
};

/// Numbers of the argument, whose values must be in the result.
void sample(const Values& values, const Span& s, Draw& draw, Case& out) {
  if (s.is_empty()) return;
  for (int k = 0; k < 2; ++k) out.must_hold(values[values.pool().pick(s, draw)]);
}

class MonotoneSource final : public Source {
 public:
  MonotoneSource(const Monotone& f, std::size_t size, Draw& draw) : values_(f.at, size, f.focus, draw) {
    for (const Piece& p : f.pieces) pieces_.push_back({p, f.at(p.lo), f.at(p.hi)});
  }

  Case next(Draw& draw) override {
    const Span s = values_.pool().span(draw);
    Case result;
    result.in[0] = values_.pool().interval(s);
    result.exact = image(s);
    sample(values_, s, draw, result);
    return result;
  }

 private:
  struct Ends {
    Piece piece;
    Bracket at_lo, at_hi;
  };

  [[nodiscard]] Interval image(const Span& s) const {
    Hull hull;
    if (s.is_empty()) return hull.interval();
    const double a = values_.pool()[s.first], b = values_.pool()[s.last];
    for (const Ends& p : pieces_) {
      if (b < p.piece.lo || a > p.piece.hi) continue;
      const Bracket& first = a <= p.piece.lo ? p.at_lo : values_[s.first];
      const Bracket& last = b >= p.piece.hi ? p.at_hi : values_[s.last];
      // A limit at an end that is no argument itself counts only where arguments lead there.
      const bool touches = b == p.piece.lo || a == p.piece.hi;
      if (touches && !(b == p.piece.lo ? p.at_lo : p.at_hi).is_finite()) continue;
      hull.add(b == p.piece.lo ? p.at_lo : last);
      hull.add(a == p.piece.hi ? p.at_hi : first);
    }
    return hull.interval();
  }

  Values values_;
  std::vector<Ends> pieces_;
};

// ---- Waves.

constexpr unsigned kTurns = 8;

/// floor(2 x / pi) modulo 8: no double but 0 is a multiple of pi/2, and none comes nearer to one than 2^-70,
/// so that 192 bits behind the point decide.
unsigned quadrant(double x) {
  if (std::abs(x) < 1.5) return x < 0 ? kTurns - 1 : 0;
  if (std::isinf(x)) return 0;
  const mpfr_prec_t precision = std::ilogb(x) + 192;
  mpfr_t turns, half_pi;
  mpfr_inits2(precision, turns, half_pi, nullptr);
  mpfr_const_pi(half_pi, MPFR_RNDN);
  mpfr_div_2ui(half_pi, half_pi, 1, MPFR_RNDN);
  mpfr_d_div(turns, x, half_pi, MPFR_RNDN);
  mpfr_floor(turns, turns);
  mpfr_fmod_ui(turns, turns, kTurns, MPFR_RNDN);
  const long part = mpfr_get_si(turns, MPFR_RNDN);
  mpfr_clears(turns, half_pi, nullptr);
  return static_cast<unsigned>(part + kTurns) % kTurns;
}

int wave_value(Wave wave, unsigned turn) {
  if (wave == Wave::cos) ++turn;
  return turn % 4 == 1 ? 1 : (turn % 4 == 3 ? -1 : 0);
}

class WaveSource final : public Source {
 public:
  WaveSource(Wave wave, std::size_t size, Draw& draw) : wave_(wave), values_(at(wave), size, focus(), draw) {
    for (std::size_t k = 0; k < values_.size(); ++k) quadrants_.push_back(quadrant(values_.pool()[k]));
  }

  Case next(Draw& draw) override {
    const Span s = values_.pool().span(draw);
    Case result;
    result.in[0] = values_.pool().interval(s);
    result.exact = image(s);
    sample(values_, s, draw, result);
    return result;
  }

  static At at(Wave wave) {
    const Unary f = wave == Wave::sin ? mpfr_sin : (wave == Wave::cos ? mpfr_cos : mpfr_tan);
    return [f](double x) { return bracket_of(f, x); };
  }
  static Focus focus() { return {-25.0, 25.0, {0x1.921fb54442d18p+0, 0x1.921fb54442d18p+1, 0x1p26, 0x1p30}}; }

 private:
  [[nodiscard]] Interval image(const Span& s) const {
    if (s.is_empty()) return Interval::empty();
    const Interval all = wave_ == Wave::tan ? Interval::entire() : Interval::raw(-1.0, 1.0);
    if (values_.pool()[s.last] - values_.pool()[s.first] > 7.0) return all;  // more than a period
    Hull hull;
    hull.add(values_[s.first]);
    hull.add(values_[s.last]);
    // The turns strictly after the first quadrant's begin; five at the most, so that their numbers modulo 8
    // do.
    for (unsigned turn = quadrants_[s.first]; turn % kTurns != quadrants_[s.last];) {
      ++turn;
      if (wave_ == Wave::tan && turn % 2 == 1) return all;
      const int value = wave_value(wave_, turn);
      if (value != 0 && wave_ != Wave::tan) hull.add({double(value), double(value)});
    }
    return hull.interval();
  }

  Wave wave_;
  Values values_;
  std::vector<unsigned> quadrants_;
};

// ---- The reverse of a function of one variable.

class ReverseSource final : public Source {
 public:
  ReverseSource(const Monotone& f, std::size_t size, Draw& draw) : values_(f.at, size, f.focus, draw) {}

  Case next(Draw& draw) override {
    const Span x = values_.pool().span(draw);
    Case result;
    result.in[1] = values_.pool().interval(x);
    const std::size_t k = x.is_empty() ? values_.pool().zero() : values_.pool().pick(x, draw);
    result.in[0] = around(values_[k], values_[1 + draw.below(values_.size() - 2)], draw);
    if (x.is_empty()) return result;
    demand(k, result);
    for (int more = 0; more < 2; ++more) demand(values_.pool().pick(x, draw), result);
    return result;
  }

 private:
  void demand(std::size_t k, Case& result) const {
    if (is_reached(values_[k], result.in[0])) result.must_hold({values_.pool()[k], values_.pool()[k]});
  }

  Values values_;
};

// ---- Case by case.

class DirectSource final : public Source {
 public:
  DirectSource(const Direct& f, Draw& draw) : f_(f), pool_(f.numbers, f.focus, draw) {}

  Case next(Draw& draw) override {
    Case result;
    std::array<double, 3> x{};
    bool some = static_cast<bool>(f_.at);
    for (std::size_t k = 0; k < f_.arity; ++k) {
      const Span s = pool_.span(draw);
      result.in[k] = pool_.interval(s);
      some = some && !s.is_empty();
      if (some) x[k] = pool_[pool_.pick(s, draw)];
    }
    result.exact = f_.exact(result.in);
    if (some) result.must_hold(f_.at(x[0], x[1], x[2]));
    return result;
  }

 private:
  Direct f_;
  Pool pool_;
};

class DirectReverseSource final : public Source {
 public:
  DirectReverseSource(At2 f, bool with_x, Draw& draw)
      : f_(std::move(f)), with_x_(with_x), pool_(20000, {}, draw) {}

  Case next(Draw& draw) override {
    const Span b = pool_.span(draw), x = with_x_ ? pool_.span(draw) : Span{0, pool_.size() - 1};
    Case result;
    result.in[0] = pool_.interval(b);
    if (with_x_) result.in[2] = pool_.interval(x);
    const double other = pool_[1 + draw.below(pool_.size() - 2)];
    if (b.is_empty() || x.is_empty()) {
      result.in[1] = around(kNone, {other, other}, draw);
      return result;
    }
    const double x0 = pool_[pool_.pick(x, draw)];
    const Bracket value = f_(x0, pool_[pool_.pick(b, draw)]);
    result.in[1] = around(value, {other, other}, draw);
    if (is_reached(value, result.in[1])) result.must_hold({x0, x0});
    return result;
  }

 private:
  At2 f_;
  bool with_x_;
  Pool pool_;
};

}  // namespace

std::unique_ptr<Source> monotone_source(const Monotone& f, std::size_t pool, Draw& draw) {
  return std::make_unique<MonotoneSource>(f, pool, draw);
}
std::unique_ptr<Source> wave_source(Wave wave, std::size_t pool, Draw& draw) {
  return std::make_unique<WaveSource>(wave, pool, draw);
}
std::unique_ptr<Source> reverse_source(const Monotone& f, std::size_t pool, Draw& draw) {
  return std::make_unique<ReverseSource>(f, pool, draw);
}
std::unique_ptr<Source> direct_source(const Direct& f, Draw& draw) {
  return std::make_unique<DirectSource>(f, draw);
}
std::unique_ptr<Source> direct_reverse_source(const At2& f, bool with_x, Draw& draw) {
  return std::make_unique<DirectReverseSource>(f, with_x, draw);
}

}  // namespace hcsp::campaign
