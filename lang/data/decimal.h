// SPDX-License-Identifier: Apache-2.0
// The numbers that people write. A decimal denotes the real number that is written, so sums and products of
// decimals are kept exactly for as long as they fit: 1700000000.3 - 1700000000 is 0.3, not a double near it.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "domains/interval/interval.h"

namespace hcsp::lang {

/// mantissa * 10^exponent.
class Decimal {
 public:
  /// None when the text is no decimal number, or has more digits than are kept.
  static std::optional<Decimal> parse(std::string_view text);

  [[nodiscard]] std::string text() const;
  /// The nearest double.
  [[nodiscard]] double nearest() const;
  /// The tightest interval around the number.
  [[nodiscard]] Interval enclosure() const;
  [[nodiscard]] bool is_whole() const { return exponent_ >= 0; }
  [[nodiscard]] bool is_odd() const { return exponent_ == 0 && mantissa_ % 2 != 0; }
  /// The value if it is a whole number that an int can hold.
  [[nodiscard]] std::optional<int> as_int() const;

  // None when the result does not fit.
  friend std::optional<Decimal> add(const Decimal& a, const Decimal& b);
  friend std::optional<Decimal> multiply(const Decimal& a, const Decimal& b);
  [[nodiscard]] Decimal negated() const { return {-mantissa_, exponent_}; }

 private:
  __extension__ using Wide = __int128;
  Decimal(Wide mantissa, int exponent) : mantissa_(mantissa), exponent_(exponent) {}
  /// Without trailing zeros, so that equal numbers look equal.
  static Decimal trimmed(Wide mantissa, int exponent);

  Wide mantissa_;
  int exponent_;
};

/// A real constant: what is known about it, and its decimal where that is exact.
struct Number {
  Interval enclosure;
  std::optional<Decimal> exact;
  /// How a number came to be that is known by its enclosure alone: equal origins, equal numbers. 0 tells
  /// nothing.
  std::uint64_t origin = 0;

  static Number of(const Decimal& decimal) { return {decimal.enclosure(), decimal}; }
  static Number of(const Interval& enclosure, std::uint64_t origin = 0) { return {enclosure, {}, origin}; }
  /// What a function makes of numbers.
  static Number of(const Interval& enclosure, std::string_view function,
                   std::initializer_list<Number> arguments);
  /// Different for different numbers, but for a chance of 2^-64 that two of one enclosure meet; 0 where
  /// nothing is known.
  [[nodiscard]] std::uint64_t identity() const;
  /// The number written in a decimal literal; none when the text is no decimal number.
  static std::optional<Number> parse(std::string_view text);
  /// The nearest double, as instants and precisions are read.
  [[nodiscard]] double nearest() const { return exact ? exact->nearest() : enclosure.mid(); }
};

Number operator-(const Number& a);
Number operator+(const Number& a, const Number& b);
Number operator-(const Number& a, const Number& b);
Number operator*(const Number& a, const Number& b);
Number operator/(const Number& a, const Number& b);

}  // namespace hcsp::lang
