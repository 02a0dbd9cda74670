// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/precise.h"

#include <algorithm>
#include <utility>

namespace hcsp::verifier {

namespace {
constexpr mpfr_prec_t kBits = 192;
}  // namespace

Precise::Precise(double lower, double upper) {
  mpfr_init2(lo_, kBits);
  mpfr_init2(hi_, kBits);
  mpfr_set_d(lo_, lower, MPFR_RNDD);
  mpfr_set_d(hi_, upper, MPFR_RNDU);
}

Precise::Precise(const Precise& other) : Precise() {
  mpfr_set(lo_, other.lo_, MPFR_RNDD);
  mpfr_set(hi_, other.hi_, MPFR_RNDU);
}

Precise::Precise(Precise&& other) noexcept : Precise() {
  mpfr_swap(lo_, other.lo_);
  mpfr_swap(hi_, other.hi_);
}

Precise& Precise::operator=(Precise other) noexcept {
  mpfr_swap(lo_, other.lo_);
  mpfr_swap(hi_, other.hi_);
  return *this;
}

Precise::~Precise() {
  mpfr_clear(lo_);
  mpfr_clear(hi_);
}

Precise Precise::decimal(const std::string& text) {
  Precise number;
  if (mpfr_set_str(number.lo_, text.c_str(), 10, MPFR_RNDD) != 0) throw std::invalid_argument(text);
  mpfr_set_str(number.hi_, text.c_str(), 10, MPFR_RNDU);
  return number;
}

Precise Precise::pi() {
  Precise number;
  mpfr_const_pi(number.lo_, MPFR_RNDD);
  mpfr_const_pi(number.hi_, MPFR_RNDU);
  return number;
}

Precise Precise::hull(const Precise& a, const Precise& b) {
  Precise both;
  mpfr_min(both.lo_, a.lo_, b.lo_, MPFR_RNDD);
  mpfr_max(both.hi_, a.hi_, b.hi_, MPFR_RNDU);
  return both;
}

Precise Precise::common(const Precise& a, const Precise& b) {
  Precise both;
  mpfr_max(both.lo_, a.lo_, b.lo_, MPFR_RNDD);
  mpfr_min(both.hi_, a.hi_, b.hi_, MPFR_RNDU);
  return both;
}

Precise operator+(const Precise& a, const Precise& b) {
  Precise sum;
  mpfr_add(sum.lo_, a.lo_, b.lo_, MPFR_RNDD);
  mpfr_add(sum.hi_, a.hi_, b.hi_, MPFR_RNDU);
  return sum;
}

Precise operator-(const Precise& a, const Precise& b) {
  Precise difference;
  mpfr_sub(difference.lo_, a.lo_, b.hi_, MPFR_RNDD);
  mpfr_sub(difference.hi_, a.hi_, b.lo_, MPFR_RNDU);
  return difference;
}

Precise operator*(const Precise& a, const Precise& b) {
  Precise product, part;
  bool first = true;
  for (const auto* x : {&a.lo_, &a.hi_}) {
    for (const auto* y : {&b.lo_, &b.hi_}) {
      mpfr_mul(part.lo_, *x, *y, MPFR_RNDD);
      mpfr_mul(part.hi_, *x, *y, MPFR_RNDU);
      if (first || mpfr_less_p(part.lo_, product.lo_) != 0) mpfr_swap(part.lo_, product.lo_);
      if (first || mpfr_greater_p(part.hi_, product.hi_) != 0) mpfr_swap(part.hi_, product.hi_);
      first = false;
      if (b.is_point()) break;
    }
    if (a.is_point()) break;
  }
  return product;
}

Precise operator/(const Precise& a, const Precise& b) {
  if (!b.is_positive() && !b.is_negative()) throw Undefined("a division by zero");
  Precise inverse;
  mpfr_ui_div(inverse.lo_, 1, b.hi_, MPFR_RNDD);
  mpfr_ui_div(inverse.hi_, 1, b.lo_, MPFR_RNDU);
  if (!a.is_point() || !b.is_point()) return a * inverse;
  mpfr_div(inverse.lo_, a.lo_, b.lo_, MPFR_RNDD);
  mpfr_div(inverse.hi_, a.lo_, b.lo_, MPFR_RNDU);
  return inverse;
}

Precise power(const Precise& a, long n) {
  if (n < 0) return Precise(1.0) / power(a, -n);
  Precise image;
  if (n % 2 == 1 || mpfr_sgn(a.lo_) >= 0) {
    mpfr_pow_si(image.lo_, a.lo_, n, MPFR_RNDD);
    mpfr_pow_si(image.hi_, a.hi_, n, MPFR_RNDU);
    return image;
  }
  if (mpfr_sgn(a.hi_) <= 0) {
    mpfr_pow_si(image.lo_, a.hi_, n, MPFR_RNDD);
    mpfr_pow_si(image.hi_, a.lo_, n, MPFR_RNDU);
    return image;
  }
  const bool is_low = mpfr_cmpabs(a.lo_, a.hi_) > 0;
  if (n == 0) return 1.0;
  mpfr_pow_si(image.hi_, is_low ? a.lo_ : a.hi_, n, MPFR_RNDU);
  return image;
}

Precise Precise::increasing(const Precise& a, Function function) {
  Precise image;
  function(image.lo_, a.lo_, MPFR_RNDD);
  function(image.hi_, a.hi_, MPFR_RNDU);
  return image;
}

Precise sqrt(const Precise& a) {
  if (a.is_negative() || mpfr_sgn(a.lo_) < 0) throw Undefined("the square root of a negative number");
  return Precise::increasing(a, mpfr_sqrt);
}

Precise log(const Precise& a) {
  if (!a.is_positive()) throw Undefined("the logarithm of a number that is not positive");
  return Precise::increasing(a, mpfr_log);
}

Precise exp(const Precise& a) { return Precise::increasing(a, mpfr_exp); }
Precise atan(const Precise& a) { return Precise::increasing(a, mpfr_atan); }

/// The value in the middle, and a slope between -1 and 1 from there; values between -1 and 1.
Precise Precise::with_slope_of_one(const Precise& a, Function function) {
  Precise middle, value;
  mpfr_add(middle.lo_, a.lo_, a.hi_, MPFR_RNDN);
  mpfr_div_2ui(middle.lo_, middle.lo_, 1, MPFR_RNDN);
  mpfr_set(middle.hi_, middle.lo_, MPFR_RNDN);
  function(value.lo_, middle.lo_, MPFR_RNDD);
  function(value.hi_, middle.hi_, MPFR_RNDU);
  return common(value + (a - middle) * Precise(-1.0, 1.0), Precise(-1.0, 1.0));
}

Precise sin(const Precise& a) { return Precise::with_slope_of_one(a, mpfr_sin); }
Precise cos(const Precise& a) { return Precise::with_slope_of_one(a, mpfr_cos); }

double Precise::middle() const { return 0.5 * mpfr_get_d(lo_, MPFR_RNDN) + 0.5 * mpfr_get_d(hi_, MPFR_RNDN); }

double Precise::width() const {
  Precise difference;
  mpfr_sub(difference.hi_, hi_, lo_, MPFR_RNDU);
  return mpfr_get_d(difference.hi_, MPFR_RNDU);
}

Precise Precise::scaled(double by) const {
  Precise product;
  mpfr_mul_d(product.lo_, by < 0 ? hi_ : lo_, by, MPFR_RNDD);
  mpfr_mul_d(product.hi_, by < 0 ? lo_ : hi_, by, MPFR_RNDU);
  return product;
}

bool Precise::lies_in(const Precise& other) const {
  return mpfr_greaterequal_p(lo_, other.lo_) != 0 && mpfr_lessequal_p(hi_, other.hi_) != 0;
}

bool Precise::lies_inside(const Precise& other) const {
  return mpfr_greater_p(lo_, other.lo_) != 0 && mpfr_less_p(hi_, other.hi_) != 0;
}

bool Precise::meets(const Precise& other) const {
  return mpfr_lessequal_p(lo_, other.hi_) != 0 && mpfr_lessequal_p(other.lo_, hi_) != 0;
}

}  // namespace hcsp::verifier
