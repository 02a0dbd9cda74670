// SPDX-License-Identifier: Apache-2.0
// Interval::of_decimal: the tightest interval around a number as written. Decimals of up to 18 digits and 22
// places, which is what data files hold, are decided in double-double arithmetic; MPFR reads the others.
#include "domains/interval/interval.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "domains/check.h"
#include "domains/interval/double_double.h"
#include "domains/interval/mpfr_scope.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

/// A mantissa below this has room for one more digit; below ten times this it is short.
constexpr std::uint64_t kShort = 1'000'000'000'000'000'000;

/// A number as written, without its sign.
struct Literal {
  std::string_view text;  // "12.50e-3", "0x1.8p+3"
  bool hexadecimal = false;
  bool is_zero = true;   // no digit but 0
  bool is_short = true;  // mantissa and exponent hold the exact value, mantissa * 10^exponent
  std::uint64_t mantissa = 0;
  int exponent = 0;
};

bool is_digit(char c, bool hexadecimal) {
  return (c >= '0' && c <= '9') || (hexadecimal && ((c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F')));
}

/// Reads a number off the front of its text, in the grammar
///   digits [. [digits]] | . digits, then [(e | E) [sign] digits]; after 0x, hexadecimal digits and p for e.
class Scanner {
 public:
  explicit Scanner(std::string_view text) { literal_.text = text; }

  /// Returns whether the whole text is a number.
  bool scan(Literal& literal) {
    if (literal_.text.size() > 2 && literal_.text[0] == '0' && (literal_.text[1] | 0x20) == 'x') {
      literal_.hexadecimal = true;
      literal_.is_short = false;
      at_ = 2;
    }
    const int whole = scan_digits(false);
    const int fraction = accept('.') ? scan_digits(true) : 0;
    const bool good = whole + fraction > 0 && scan_exponent() && at_ == literal_.text.size();
    literal = literal_;
    return good;
  }

 private:
  [[nodiscard]] char peek() const { return at_ < literal_.text.size() ? literal_.text[at_] : '\0'; }

  bool accept(char c) {
    const bool found = at_ < literal_.text.size() && literal_.text[at_] == c;
    at_ += found ? 1 : 0;
    return found;
  }

  int scan_digits(bool fraction) {
    int count = 0;
    for (; is_digit(peek(), literal_.hexadecimal); ++at_, count = 1) {
      literal_.is_zero = literal_.is_zero && peek() == '0';
      if (!literal_.is_short) continue;
      literal_.mantissa = literal_.mantissa * 10 + static_cast<std::uint64_t>(peek() - '0');
      literal_.exponent -= fraction ? 1 : 0;
      literal_.is_short = literal_.mantissa < kShort && literal_.exponent > -1000;
    }
    return count;
  }

  bool scan_exponent() {
    const char letter = static_cast<char>(peek() | 0x20);
    if (letter != (literal_.hexadecimal ? 'p' : 'e')) return true;
    ++at_;
    const bool negative = accept('-');
    if (!negative) accept('+');
    int value = 0;
    const std::size_t start = at_;
    for (; is_digit(peek(), false); ++at_) value = value < 100000 ? value * 10 + (peek() - '0') : value;
    literal_.exponent += negative ? -value : value;
    return at_ > start;
  }

  Literal literal_;
  std::size_t at_ = 0;
};

constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};  // exact

Interval point(double x) { return Interval::raw(x, x); }

/// The doubles around value > 0, a normal number, when it is so well away from value.hi that its error does
/// not count.
Interval around(DoubleDouble value, double error) {
  const auto bits = std::bit_cast<std::uint64_t>(value.hi);
  if (value.lo > error) return Interval::raw(value.hi, std::bit_cast<double>(bits + 1));
  if (value.lo < -error) return Interval::raw(std::bit_cast<double>(bits - 1), value.hi);
  return Interval::empty();
}

/// Decides a short literal, or returns the empty set. PRECONDITION: round to nearest. For mantissas up to
/// 2^53, the rounding error of one product or quotient of exact doubles is exact, so its sign decides even
/// where it is zero.
Interval of_short(const Literal& literal) {
  const std::size_t places = static_cast<std::size_t>(std::abs(literal.exponent));
  if (!literal.is_short || places >= kPowersOfTen.size()) return Interval::empty();
  const double power = kPowersOfTen[places];
  const bool exact = literal.mantissa <= (std::uint64_t{1} << 53);
  const auto high = static_cast<double>(literal.mantissa & ~std::uint64_t{0x7ff});
  const DoubleDouble mantissa = fast_two_sum(high, static_cast<double>(literal.mantissa & 0x7ff));
  const DoubleDouble value =
      literal.exponent < 0 ? divide(mantissa, {power, 0.0}) : multiply(mantissa, power);
  if (exact && value.lo == 0) return point(value.hi);
  return around(value, exact ? 0.0 : 0x1p-95 * value.hi);
}

/// By MPFR: to 53 bits, then again where the result is subnormal: twice in one direction is the same as once.
Interval of_long(const Literal& literal) {
  const std::string text(literal.text);
  const int base = literal.hexadecimal ? 16 : 10;
  MpfrScope scope;
  Number value(mpfr_prec_t{53});
  mpfr_strtofr(value.get(), text.c_str(), nullptr, base, MPFR_RNDD);
  const double lo = mpfr_get_d(value.get(), MPFR_RNDD);
  mpfr_strtofr(value.get(), text.c_str(), nullptr, base, MPFR_RNDU);
  const double hi = mpfr_get_d(value.get(), MPFR_RNDU);
  return Interval::raw(lo, hi);
}

// To leave a guard's lifetime.
Interval with_sign(const Interval& magnitude, bool negative) {
  const Interval fenced = Interval::raw(opaque(magnitude.lo()), opaque(magnitude.hi()));
  return negative ? -fenced : fenced;
}

}  // namespace

Interval Interval::of_decimal(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  const bool has_sign = negative || (!text.empty() && text.front() == '+');
  Literal literal;
  const bool good = Scanner(text.substr(has_sign ? 1 : 0)).scan(literal);
  require(good, "Interval::of_decimal: \"{}\" is not a number", text);
  if (literal.is_zero) return point(0.0);
  RoundNearest guard;
  Interval magnitude = of_short(literal);
  if (magnitude.is_empty()) magnitude = of_long(literal);
  return with_sign(magnitude, negative);
}

Interval Interval::of_decimal(std::int64_t mantissa, int exponent) {
  if (mantissa == 0) return point(0.0);
  const bool negative = mantissa < 0;
  Literal literal;
  literal.mantissa =
      negative ? 0 - static_cast<std::uint64_t>(mantissa) : static_cast<std::uint64_t>(mantissa);
  literal.exponent = exponent;
  literal.is_short = literal.mantissa < 10 * kShort;
  {
    RoundNearest guard;
    const Interval magnitude = of_short(literal);
    if (!magnitude.is_empty()) return with_sign(magnitude, negative);
  }
  return of_decimal(fmt::format("{}e{}", mantissa, exponent));
}

}  // namespace hcsp
