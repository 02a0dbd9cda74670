// SPDX-License-Identifier: Apache-2.0
// Polynomials with exponents of both signs in one unknown, and where they may be zero.
#pragma once

#include <vector>

#include "tests/straight_line/number.h"

namespace hcsp::straight_line {

/// sum of coefficients[i] z^(i + lowest).
class Polynomial {
 public:
  Polynomial(Number constant = 0)
      : coefficients_{constant} {}  // NOLINT(google-explicit-constructor): a number is one
  Polynomial(int lowest, std::vector<Number> coefficients)
      : lowest_(lowest), coefficients_(std::move(coefficients)) {}
  /// The unknown.
  static Polynomial z() { return {1, {1}}; }

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial(-1) * b; }

  [[nodiscard]] Number at(const Number& z) const;

  /// Every zero in (0, top] or, if no exponent is negative, [bottom, top], to the last bits; besides, points
  /// where the polynomial is not zero: those where a derivative is, so that a zero which rounding hides is
  /// among them.
  [[nodiscard]] std::vector<Number> candidates(const Number& bottom, const Number& top) const;

 private:
  int lowest_ = 0;
  std::vector<Number> coefficients_;
};

}  // namespace hcsp::straight_line
