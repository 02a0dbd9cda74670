// SPDX-License-Identifier: Apache-2.0
// Intervals of MPFR numbers: the arithmetic of the verifier, which shares no code with the library.
#pragma once

#include <mpfr.h>

#include <stdexcept>
#include <string>

namespace hcsp::verifier {

/// A function where it has no value: nothing can be said of the expression.
struct Undefined : std::domain_error {
  using std::domain_error::domain_error;
};

/// A closed interval. Every operation gives a superset of the image, and throws Undefined where a point of
/// its operands has none.
class Precise {
 public:
  Precise(double x = 0.0) : Precise(x, x) {}  // NOLINT(google-explicit-constructor): a double is a point
  Precise(double lower, double upper);
  Precise(const Precise& other);
  Precise(Precise&& other) noexcept;
  Precise& operator=(Precise other) noexcept;
  ~Precise();

  /// The number that a decimal denotes, enclosed. Throws std::invalid_argument if it is none.
  static Precise decimal(const std::string& text);
  static Precise pi();
  /// The least interval around both.
  static Precise hull(const Precise& a, const Precise& b);
  /// What two intervals have in common; they must meet.
  static Precise common(const Precise& a, const Precise& b);

  friend Precise operator+(const Precise& a, const Precise& b);
  friend Precise operator-(const Precise& a, const Precise& b);
  friend Precise operator*(const Precise& a, const Precise& b);
  friend Precise operator/(const Precise& a, const Precise& b);
  friend Precise power(const Precise& a, long n);
  friend Precise sqrt(const Precise& a);
  friend Precise exp(const Precise& a);
  friend Precise log(const Precise& a);
  friend Precise sin(const Precise& a);
  friend Precise cos(const Precise& a);
  friend Precise atan(const Precise& a);

  /// The double nearest to the middle.
  [[nodiscard]] double middle() const;
  [[nodiscard]] double width() const;
  /// This times a double.
  [[nodiscard]] Precise scaled(double by) const;
  [[nodiscard]] bool is_zero() const { return mpfr_zero_p(lo_) != 0 && mpfr_zero_p(hi_) != 0; }
  [[nodiscard]] bool is_point() const { return mpfr_equal_p(lo_, hi_) != 0; }
  [[nodiscard]] bool is_positive() const { return mpfr_sgn(lo_) > 0; }
  [[nodiscard]] bool is_negative() const { return mpfr_sgn(hi_) < 0; }
  [[nodiscard]] bool is_at_most_zero() const { return mpfr_sgn(hi_) <= 0; }
  [[nodiscard]] bool lies_in(const Precise& other) const;
  [[nodiscard]] bool lies_inside(const Precise& other) const;  ///< of its interior
  [[nodiscard]] bool meets(const Precise& other) const;

 private:
  using Function = int (*)(mpfr_t, const mpfr_t, mpfr_rnd_t);
  static Precise increasing(const Precise& a, Function function);
  static Precise with_slope_of_one(const Precise& a, Function function);

  mpfr_t lo_, hi_;
};

}  // namespace hcsp::verifier
