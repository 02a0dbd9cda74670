// SPDX-License-Identifier: Apache-2.0
// Random and corner numbers, and the intervals between them, for the soundness campaign: subnormal, huge,
// zero, infinite, points, one ulp wide, about a function's critical points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp::campaign {

/// Where a function is worth a look: a third of the numbers are drawn evenly from [lo, hi], a tenth from
/// within a few ulps of the points.
struct Focus {
  double lo = -10.0, hi = 10.0;
  std::vector<double> points = {-1.0, 1.0};
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}

  /// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>((bits() >> 32) * n >> 32); }
  double within(double lo, double hi) { return lo + (hi - lo) * 0x1p-53 * static_cast<double>(bits() >> 11); }
  /// A finite number.
  double number(const Focus& focus);

 private:
  double corner(std::size_t kind);
  double signed_power(double lowest, double highest);
  std::uint64_t state_;
};

/// x moved by that many ulps.
double step(double x, int ulps);

/// The numbers from first to last of a pool; none where first > last.
struct Span {
  std::size_t first = 1, last = 0;
  [[nodiscard]] bool is_empty() const { return first > last; }
};

/// Numbers in order, -oo the first and +oo the last. Its pairs are the intervals of a run, so that a function
/// is evaluated once a number and every pair is a case.
class Pool {
 public:
  Pool(std::size_t size, const Focus& focus, Draw& draw);

  [[nodiscard]] std::size_t size() const { return numbers_.size(); }
  [[nodiscard]] double operator[](std::size_t k) const { return numbers_[k]; }
  /// Where 0 is, and which there is once.
  [[nodiscard]] std::size_t zero() const { return zero_; }
  /// The interval between two numbers; bounds of 0 have either sign.
  [[nodiscard]] Interval interval(const Span& s) const;
  Span span(Draw& draw) const;
  /// A finite number of a span that is not empty.
  static std::size_t pick(const Span& s, std::size_t size, Draw& draw);
  std::size_t pick(const Span& s, Draw& draw) const { return pick(s, size(), draw); }

 private:
  std::vector<double> numbers_;
  std::size_t zero_;
};

}  // namespace hcsp::campaign
