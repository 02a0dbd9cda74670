// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/polynomial.h"

#include <algorithm>

namespace hcsp::straight_line {

namespace {

using Coefficients = std::vector<Number>;

Number value(const Coefficients& c, const Number& z) {
  Number sum = 0;
  for (auto i = c.rbegin(); i != c.rend(); ++i) sum = sum * z + *i;
  return sum;
}

Coefficients derivative(const Coefficients& c) {
  Coefficients d;
  for (std::size_t i = 1; i < c.size(); ++i) d.push_back(c[i] * i);
  return d;
}

/// The zero between two points where the signs differ: Newton's method, and bisection where it leaves the
/// bracket.
Number zero_between(const Coefficients& c, const Coefficients& slope, Number lower, Number upper) {
  const bool rises = value(c, lower) < 0;
  Number z = (lower + upper) / 2;
  for (int i = 0; i < 400; ++i) {
    const Number v = value(c, z);
    if (v == 0) return z;
    ((v < 0) == rises ? lower : upper) = z;
    const Number s = value(slope, z);
    Number next = s == 0 ? lower : z - v / s;
    const bool is_inside = next > lower && next < upper;
    if (!is_inside || i % 8 == 7) next = (lower + upper) / 2;
    if (next == z || upper - lower <= ldexp(abs(z), -188)) return z;
    z = next;
  }
  return z;
}

Coefficients zeros(const Coefficients& c, const Number& bottom, const Number& top) {
  Coefficients points{bottom};
  if (c.size() < 2) return {bottom, top};
  const Coefficients slope = derivative(c);
  for (const Number& z : zeros(slope, bottom, top)) points.push_back(z);
  points.push_back(top);
  std::sort(points.begin(), points.end());
  Coefficients found = points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Number a = value(c, points[i]);
    const Number b = value(c, points[i + 1]);
    if ((a < 0 && b > 0) || (a > 0 && b < 0))
      found.push_back(zero_between(c, slope, points[i], points[i + 1]));
  }
  return found;
}

}  // namespace

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  const int lowest = std::min(a.lowest_, b.lowest_);
  const int highest = std::max(a.lowest_ + static_cast<int>(a.coefficients_.size()),
                               b.lowest_ + static_cast<int>(b.coefficients_.size()));
  Polynomial sum(lowest, std::vector<Number>(static_cast<std::size_t>(highest - lowest), Number(0)));
  for (const Polynomial* p : {&a, &b}) {
    for (std::size_t i = 0; i < p->coefficients_.size(); ++i) {
      sum.coefficients_[i + static_cast<std::size_t>(p->lowest_ - lowest)] += p->coefficients_[i];
    }
  }
  return sum;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.lowest_ + b.lowest_,
                     std::vector<Number>(a.coefficients_.size() + b.coefficients_.size() - 1, Number(0)));
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i) {
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j) {
      product.coefficients_[i + j] += a.coefficients_[i] * b.coefficients_[j];
    }
  }
  return product;
}

Number Polynomial::at(const Number& z) const { return value(coefficients_, z) * pow(z, lowest_); }

std::vector<Number> Polynomial::candidates(const Number& bottom, const Number& top) const {
  // z^lowest has no zero besides 0, and for a positive exponent zero is among the bottoms that callers pass.
  return zeros(coefficients_, bottom, top);
}

}  // namespace hcsp::straight_line
