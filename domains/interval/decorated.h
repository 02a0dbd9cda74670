// SPDX-License-Identifier: Apache-2.0
// Decorated intervals (IEEE 1788-2015, clause 11): an interval with what is known of the function that gave
// it on the box that it was evaluated on.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "domains/interval/functions.h"
#include "domains/interval/interval.h"

namespace hcsp {

/// From worst to best: the interval is no interval (NaI); nothing is known; defined on the box; defined and
/// continuous; defined and continuous, box and result bounded.
enum class Decoration : std::uint8_t { ill = 0, trv = 4, def = 8, dac = 12, com = 16 };

class DecoratedInterval {
 public:
  /// With the best decoration that an interval can have: newDec.
  explicit DecoratedInterval(const Interval& a);
  /// setDec: the decoration is lowered where the interval cannot have it; ill gives NaI.
  DecoratedInterval(const Interval& a, Decoration d);
  static DecoratedInterval nai();
  /// A literal of IEEE 1788-2015, 9.7 and 12.11, with or without decoration: "[1, 2]_com", "3.56?1", "[nai]".
  /// Throws std::invalid_argument when it is none.
  static DecoratedInterval of_text(std::string_view text);

  /// The interval part; the empty set of NaI.
  [[nodiscard]] const Interval& interval() const { return interval_; }
  [[nodiscard]] Decoration decoration() const { return decoration_; }
  [[nodiscard]] bool is_nai() const { return decoration_ == Decoration::ill; }
  /// Equal intervals; NaI equals nothing. Decorations are not compared.
  friend bool operator==(const DecoratedInterval& a, const DecoratedInterval& b) {
    return !a.is_nai() && !b.is_nai() && a.interval_ == b.interval_;
  }

 private:
  Interval interval_;
  Decoration decoration_;
};

/// "[1, 2]_com", "[empty]_trv", "[nai]".
std::string to_string(const DecoratedInterval& a);

DecoratedInterval operator-(const DecoratedInterval& a);
DecoratedInterval operator+(const DecoratedInterval& a, const DecoratedInterval& b);
DecoratedInterval operator-(const DecoratedInterval& a, const DecoratedInterval& b);
DecoratedInterval operator*(const DecoratedInterval& a, const DecoratedInterval& b);
DecoratedInterval operator/(const DecoratedInterval& a, const DecoratedInterval& b);
DecoratedInterval recip(const DecoratedInterval& a);
DecoratedInterval sqr(const DecoratedInterval& a);
DecoratedInterval sqrt(const DecoratedInterval& a);
DecoratedInterval fma(const DecoratedInterval& a, const DecoratedInterval& b, const DecoratedInterval& c);
DecoratedInterval pown(const DecoratedInterval& a, int n);
DecoratedInterval pow(const DecoratedInterval& a, const DecoratedInterval& b);
DecoratedInterval rootn(const DecoratedInterval& a, int n);
DecoratedInterval exp(const DecoratedInterval& a);
DecoratedInterval exp2(const DecoratedInterval& a);
DecoratedInterval exp10(const DecoratedInterval& a);
DecoratedInterval expm1(const DecoratedInterval& a);
DecoratedInterval log(const DecoratedInterval& a);
DecoratedInterval log2(const DecoratedInterval& a);
DecoratedInterval log10(const DecoratedInterval& a);
DecoratedInterval log1p(const DecoratedInterval& a);
DecoratedInterval sin(const DecoratedInterval& a);
DecoratedInterval cos(const DecoratedInterval& a);
DecoratedInterval tan(const DecoratedInterval& a);
DecoratedInterval asin(const DecoratedInterval& a);
DecoratedInterval acos(const DecoratedInterval& a);
DecoratedInterval atan(const DecoratedInterval& a);
DecoratedInterval atan2(const DecoratedInterval& y, const DecoratedInterval& x);
DecoratedInterval sinh(const DecoratedInterval& a);
DecoratedInterval cosh(const DecoratedInterval& a);
DecoratedInterval tanh(const DecoratedInterval& a);
DecoratedInterval asinh(const DecoratedInterval& a);
DecoratedInterval acosh(const DecoratedInterval& a);
DecoratedInterval atanh(const DecoratedInterval& a);
DecoratedInterval sign(const DecoratedInterval& a);
DecoratedInterval ceil(const DecoratedInterval& a);
DecoratedInterval floor(const DecoratedInterval& a);
DecoratedInterval trunc(const DecoratedInterval& a);
DecoratedInterval round_ties_to_even(const DecoratedInterval& a);
DecoratedInterval round_ties_to_away(const DecoratedInterval& a);
DecoratedInterval abs(const DecoratedInterval& a);
DecoratedInterval min(const DecoratedInterval& a, const DecoratedInterval& b);
DecoratedInterval max(const DecoratedInterval& a, const DecoratedInterval& b);
/// Where b is nowhere 0 the first part is the quotient c / b with its decoration; parts are trv elsewhere.
std::array<DecoratedInterval, 2> mul_rev_to_pair(const DecoratedInterval& b, const DecoratedInterval& c);
/// Operations that are no point functions (reverses, cancellation, intersection, hull) on the interval parts:
/// trv, or NaI where an operand is.
template <class Operation, class... Operands>
DecoratedInterval trivially(Operation operation, const Operands&... operands) {
  if ((operands.is_nai() || ...)) return DecoratedInterval::nai();
  return {operation(operands.interval()...), Decoration::trv};
}

}  // namespace hcsp
