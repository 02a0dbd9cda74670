// SPDX-License-Identifier: Apache-2.0
#include "solver/phases/phase_function.h"

#include <algorithm>
#include <cmath>

#include "domains/check.h"
#include "solver/phases/folding.h"

namespace hcsp {

namespace {

// No model means more; a product of products doubles the degree each time. Binomials of higher degrees are no
// doubles.
constexpr std::size_t kHighestDegree = 48;

LocalPolynomial trimmed(std::vector<Expr> coefficients) {
  while (coefficients.size() > 1 && folding::is_number(coefficients.back(), 0.0)) coefficients.pop_back();
  return {std::move(coefficients)};
}

Expr coefficient_of(const LocalPolynomial& a, std::size_t k) {
  return k < a.coefficients.size() ? a.coefficients[k] : folding::number(a.coefficients[0].dag(), 0.0);
}

// Coefficient by coefficient.
template <class Operation>
LocalPolynomial combined(const LocalPolynomial& a, const LocalPolynomial& b, Operation operation) {
  std::vector<Expr> all;
  for (std::size_t k = 0; k <= std::max(a.degree(), b.degree()); ++k)
    all.push_back(operation(coefficient_of(a, k), coefficient_of(b, k)));
  return trimmed(std::move(all));
}

// Leibniz's rule: the coefficients are derivatives at 0.
LocalPolynomial product(const LocalPolynomial& a, const LocalPolynomial& b) {
  std::vector<Expr> all;
  for (std::size_t n = 0; n <= a.degree() + b.degree(); ++n) {
    Expr total = folding::number(a.coefficients[0].dag(), 0.0);
    double ways = 1.0;  // n over i
    for (std::size_t i = 0; i <= n; ++i) {
      if (i <= a.degree() && n - i <= b.degree()) {
        const Expr term = folding::product(a.coefficients[i], b.coefficients[n - i]);
        total = folding::sum(total, folding::product(folding::number(term.dag(), ways), term));
      }
      ways = ways * static_cast<double>(n - i) / static_cast<double>(i + 1);
    }
    all.push_back(total);
  }
  return trimmed(std::move(all));
}

Piece product(const Piece& a, const Piece& b) {
  return {product(a.polynomial, b.polynomial), folding::product(a.end, b.end)};
}

std::optional<Piece> power(const Piece& base, const Expr& exponent) {
  const Interval& value = exponent.dag()[exponent.node()].value;
  const double n = value.lo();
  if (!value.is_point() || n < 1.0 || n * static_cast<double>(base.polynomial.degree()) > kHighestDegree)
    return {};
  Piece result = base;
  for (double k = 1.0; k < n; ++k) result.polynomial = product(result.polynomial, base.polynomial);
  result.end = pown(base.end, static_cast<int>(n));
  return result;
}

// Of what is constant during a phase any operator is.
std::optional<Piece> of_constants(Op op, const std::vector<Piece>& operands) {
  std::vector<Expr> starts, ends;
  for (const Piece& operand : operands) {
    if (operand.polynomial.degree() > 0) return {};
    starts.push_back(operand.start());
    ends.push_back(operand.end);
  }
  return Piece{{{operate(op, starts)}}, operate(op, ends)};
}

std::optional<Piece> apply(Op op, const std::vector<Piece>& operands) {
  const Piece& a = operands.front();
  const Piece& b = operands.back();
  switch (op) {
    case Op::neg:
      return Piece{combined(a.polynomial, a.polynomial, [](Expr x, Expr) { return folding::negated(x); }),
                   folding::negated(a.end)};
    case Op::add:
      return Piece{combined(a.polynomial, b.polynomial, folding::sum), folding::sum(a.end, b.end)};
    case Op::sub:
      return Piece{combined(a.polynomial, b.polynomial, folding::difference),
                   folding::difference(a.end, b.end)};
    case Op::mul:
      if (a.polynomial.degree() + b.polynomial.degree() > kHighestDegree) return {};
      return product(a, b);
    case Op::sqr:
      if (2 * a.polynomial.degree() > kHighestDegree) return {};
      return product(a, a);
    case Op::pown:
      if (a.polynomial.degree() > 0) return power(a, b.start());
      return of_constants(op, operands);
    case Op::div: {
      if (b.polynomial.degree() > 0) return {};
      const auto divided = [&](Expr x, Expr) {
        return folding::is_number(b.start(), 1.0) ? x : x / b.start();
      };
      return Piece{combined(a.polynomial, a.polynomial, divided), divided(a.end, a.end)};
    }
    default:
      return of_constants(op, operands);
  }
}

}  // namespace

Expr LocalPolynomial::at(Expr local_time) const {
  Expr value = coefficients.back();
  for (std::size_t k = coefficients.size() - 1; k > 0; --k) {
    const Expr step = folding::quotient(local_time, static_cast<double>(k));
    value = folding::sum(coefficients[k - 1], folding::product(step, value));
  }
  return value;
}

LocalPolynomial LocalPolynomial::derivative() const {
  if (degree() == 0) return {{folding::number(coefficients[0].dag(), 0.0)}};
  return {{coefficients.begin() + 1, coefficients.end()}};
}

PhaseFunction::PhaseFunction(const std::vector<Expr>& durations, Expr always) : is_continuous_(true) {
  for (std::size_t i = 0; i < durations.size(); ++i) pieces_.push_back({{{always}}, always});
}

PhaseFunction PhaseFunction::hold(const std::vector<Expr>& values) {
  std::vector<Piece> pieces;
  for (const Expr& value : values) pieces.push_back({{{value}}, value});
  return PhaseFunction(std::move(pieces), false);
}

PhaseFunction PhaseFunction::integral(const std::vector<Expr>& durations, const PhaseFunction& derivative,
                                      Expr start) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const LocalPolynomial& slope = derivative.pieces()[i].polynomial;
    std::vector<Expr> coefficients{start};
    coefficients.insert(coefficients.end(), slope.coefficients.begin(), slope.coefficients.end());
    Piece piece{trimmed(std::move(coefficients)), start};
    piece.end = start = piece.polynomial.at(durations[i]);
    pieces.push_back(std::move(piece));
  }
  return PhaseFunction(std::move(pieces), true);
}

PhaseFunction PhaseFunction::between(std::size_t from, std::size_t to) const {
  const auto begin = pieces_.begin();
  return PhaseFunction({begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(to)},
                       is_continuous_);
}

Expr PhaseFunction::at_gate(std::size_t gate) const {
  return gate < pieces_.size() ? pieces_[gate].start() : pieces_.back().end;
}

std::optional<Expr> PhaseFunction::constant() const {
  const Expr& first = pieces_.front().end;
  const bool is_one = std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
    return piece.polynomial.degree() == 0 && piece.start().node() == first.node() &&
           piece.end.node() == first.node();
  });
  return is_one ? std::optional(first) : std::nullopt;
}

std::optional<PhaseFunction> PhaseFunction::apply(Op op, const std::vector<PhaseFunction>& operands) {
  std::vector<Piece> pieces;
  bool is_continuous = true;
  for (const PhaseFunction& operand : operands) is_continuous = is_continuous && operand.is_continuous();
  for (std::size_t i = 0; i < operands.front().pieces().size(); ++i) {
    std::vector<Piece> of_phase;
    for (const PhaseFunction& operand : operands) of_phase.push_back(operand.pieces()[i]);
    auto made = hcsp::apply(op, of_phase);
    if (!made) return {};
    pieces.push_back(std::move(*made));
  }
  return PhaseFunction(std::move(pieces), is_continuous);
}

}  // namespace hcsp
