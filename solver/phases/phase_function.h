// SPDX-License-Identifier: Apache-2.0
// A function of time that is a polynomial on each of the phases which a time line is made of. Phase i takes
// so long as durations[i] says, an expression; a coefficient is an expression, too, so that all that can be
// said of the function is a relation between reals. A phase of no length counts as the instant that it is.
#pragma once

#include <memory>
#include <optional>

#include "solver/expression/expr.h"

namespace hcsp {

/// A polynomial in the local time s of a phase: the sum of coefficients[k] s^k/k!. Then a derivative has the
/// very same coefficients, moved by one place.
struct LocalPolynomial {
  std::vector<Expr> coefficients;  ///< one at least; the last is no literal 0 unless it is the only one

  [[nodiscard]] std::size_t degree() const { return coefficients.size() - 1; }
  [[nodiscard]] Expr at(Expr local_time) const;
  [[nodiscard]] LocalPolynomial derivative() const;
};

/// What a function does on one phase. Its value at the end is an expression of its own: the one that the next
/// phase starts with, where the function is continuous.
struct Piece {
  LocalPolynomial polynomial;
  Expr end;
  [[nodiscard]] Expr start() const { return polynomial.coefficients.front(); }
};

class PhaseFunction {
 public:
  /// The function that is the expression all the time.
  PhaseFunction(const std::vector<Expr>& durations, Expr always);
  /// That is values[i] throughout phase i.
  static PhaseFunction hold(const std::vector<Expr>& values);
  /// The continuous function with this derivative and this value at the start.
  static PhaseFunction integral(const std::vector<Expr>& durations, const PhaseFunction& derivative,
                                Expr start);

  explicit PhaseFunction(std::vector<Piece> pieces, bool is_continuous)
      : pieces_(std::move(pieces)), is_continuous_(is_continuous) {}

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// Known for how it is made: a function that happens to have no jumps may be called not continuous.
  [[nodiscard]] bool is_continuous() const { return is_continuous_; }
  /// What it does from one gate to a later one.
  [[nodiscard]] PhaseFunction between(std::size_t from, std::size_t to) const;
  /// At the start of a phase, or at the end of the last.
  [[nodiscard]] Expr at_gate(std::size_t gate) const;
  /// Where it is the same expression all the time: that.
  [[nodiscard]] std::optional<Expr> constant() const;

  /// An operator, of as many functions as it takes; none where no polynomials come of it.
  static std::optional<PhaseFunction> apply(Op op, const std::vector<PhaseFunction>& operands);

 private:
  std::vector<Piece> pieces_;
  bool is_continuous_;
};

}  // namespace hcsp
