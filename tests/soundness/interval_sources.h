// SPDX-License-Identifier: Apache-2.0
// Endless cases of an operation on intervals, each with what MPFR says of its result. A source evaluates its
// function once for each number of a pool (once for each pair, where it has two arguments), before the first
// case; every pair of numbers is then an interval with a known image. Sums, products, quotients and fma are
// evaluated for each case.
#pragma once

#include <array>
#include <climits>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/soundness/bracket.h"
#include "tests/soundness/interval_draw.h"

namespace hcsp::campaign {

using Arguments = std::array<Interval, 3>;
/// The result, and a second one of the few operations that have two.
using Outcome = std::array<Interval, 2>;

/// What must hold of an outcome.
enum class Promise : std::uint8_t {
  tightest,      ///< the first is `exact`
  part_of_last,  ///< the first is within the last argument
  either,        ///< each number is in one of the two, which are in order
  each           ///< the k-th number is in the k-th, within the last but one and the last argument
};

struct Case {
  Arguments in;
  Interval exact;
  /// Numbers that the first result must hold, or as promised.
  std::array<Bracket, 3> inside;
  std::size_t count = 0;

  void must_hold(const Bracket& b) {
    if (b.exists() && b.is_finite()) inside[count++] = b;
  }
};

/// What a reverse operation is told of a value: an interval around it, mostly the tightest, sometimes with
/// another value, one-sided or, to see that it does not matter, without it.
Interval around(const Bracket& value, const Bracket& other, Draw& draw);
/// Whether a value is a real number that is surely in c.
inline bool is_reached(const Bracket& value, const Interval& c) {
  return value.exists() && value.is_finite() && value.is_within(c);
}

class Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual Case next(Draw& draw) = 0;
};

struct Operation {
  std::string name;
  std::size_t arity;
  Promise promise;
  /// Variants, such as exponents, that share the cases of the operation.
  std::size_t variants;
  std::function<Outcome(const Arguments&, std::size_t variant)> apply;
  std::function<std::unique_ptr<Source>(Draw&, std::size_t variant)> source;
  /// Whether it withstands a caller that flushes subnormal numbers: all but the lattice's comparisons in
  /// line.
  bool flushes = true;
};

/// Every operation of the campaign.
const std::vector<Operation>& operations();
/// Those that give numbers or truth values, and the lattice's.
void add_numbers(std::vector<Operation>& all);

/// The value of a point function, in both roundings.
using At = std::function<Bracket(double)>;
using At2 = std::function<Bracket(double, double)>;
using At3 = std::function<Bracket(double, double, double)>;
/// Between ends a function of one variable is monotone; an end's value is the limit from the inside, for
/// which -0.0 stands for 0 from below.
struct Piece {
  double lo, hi;
};

/// A function that is monotone in pieces, and its reverse operation.
struct Monotone {
  At at;
  std::vector<Piece> pieces;
  Focus focus;
};
enum class Wave : std::uint8_t { sin, cos, tan };

std::unique_ptr<Source> monotone_source(const Monotone& f, std::size_t pool, Draw& draw);
std::unique_ptr<Source> wave_source(Wave wave, std::size_t pool, Draw& draw);
/// Arguments c, x with f(x0) in c for an x0 in x.
std::unique_ptr<Source> reverse_source(const Monotone& f, std::size_t pool, Draw& draw);

/// Cases whose image is computed case by case.
struct Direct {
  std::size_t arity;
  std::function<Interval(const Arguments&)> exact;
  /// Of a point; not called where empty.
  At3 at;
  Focus focus;
  std::size_t numbers = 20000;
};
std::unique_ptr<Source> direct_source(const Direct& f, Draw& draw);
/// Arguments b, c, x with f(x0, b0) in c for an x0 in x and b0 in b; without x, for an operation that takes
/// none, x being the whole line.
std::unique_ptr<Source> direct_reverse_source(const At2& f, bool with_x, Draw& draw);

enum class Surface : std::uint8_t { atan2, pow };
std::unique_ptr<Source> surface_source(Surface surface, std::size_t side, Draw& draw);
/// Which arguments of z = f(first, second) a reverse operation contracts, and their order.
enum class Contracts : std::uint8_t { first, second, both };
std::unique_ptr<Source> surface_reverse_source(Surface surface, Contracts contracts, std::size_t side,
                                               Draw& draw);

/// A reverse operation whose every other case is around a real solution, seldom a double.
Operation with_witnesses(Operation operation, std::size_t count);
/// The variants of pown and pown_rev.
inline constexpr std::array kExponents = {-1, -2, -3, -4, -8, -17, INT_MIN, 0,    1,    2,
                                          3,  4,  5,  7,  8,  10,  53,      1000, 1001, INT_MAX};

}  // namespace hcsp::campaign
