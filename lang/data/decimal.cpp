// SPDX-License-Identifier: Apache-2.0
#include "lang/data/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hcsp::lang {

namespace {

constexpr int kMostDigits = 36;         // of a mantissa: below 2^127
constexpr int kLargestExponent = 5000;  // beyond it a literal is 0 or oo to every double

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// [+-]? (digits [. digits*] | . digits) [(e|E) [+-]? digits]
bool is_decimal(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - begin;
  };
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  std::size_t count = digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    count += digits();
  }
  if (count == 0) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (digits() == 0) return false;
  }
  return at == text.size();
}

}  // namespace

Decimal Decimal::trimmed(Wide mantissa, int exponent) {
  if (mantissa == 0) return {0, 0};
  while (exponent < 0 && mantissa % 10 == 0) {
    mantissa /= 10;
    ++exponent;
  }
  return {mantissa, exponent};
}

std::optional<Decimal> Decimal::parse(std::string_view text) {
  if (!is_decimal(text)) return {};
  const bool negative = text.front() == '-';
  if (negative || text.front() == '+') text.remove_prefix(1);
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  int exponent = 0;
  if (e < text.size()) {
    std::string_view written = text.substr(e + 1);
    if (written.front() == '+') written.remove_prefix(1);
    const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), exponent);
    if (error != std::errc() || std::abs(exponent) > kLargestExponent) return {};
  }
  Wide mantissa = 0;
  int digits = 0;
  bool after_point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') {
      after_point = true;
      continue;
    }
    if (mantissa != 0 || c != '0') ++digits;
    if (digits > kMostDigits) return {};
    mantissa = 10 * mantissa + (c - '0');
    if (after_point) --exponent;
  }
  return trimmed(negative ? -mantissa : mantissa, exponent);
}

std::string Decimal::text() const {
  std::array<char, 48> buffer{};  // 39 digits at most, from the end
  std::size_t at = buffer.size();
  Wide rest = mantissa_ < 0 ? -mantissa_ : mantissa_;
  for (; rest > std::numeric_limits<std::uint64_t>::max(); rest /= 10) {
    buffer[--at] = static_cast<char>('0' + static_cast<int>(rest % 10));
  }
  auto narrow = static_cast<std::uint64_t>(rest);
  do buffer[--at] = static_cast<char>('0' + narrow % 10);
  while ((narrow /= 10) != 0);
  if (mantissa_ < 0) buffer[--at] = '-';
  return fmt::format("{}e{}", std::string_view(&buffer[at], buffer.size() - at), exponent_);
}

double Decimal::nearest() const {
  const std::string written = text();
  double value = 0.0;
  const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), value);
  // Out of range: nearest to zero, or beyond the largest double.
  if (error != std::errc())
    value = exponent_ < 0 ? 0.0 : std::copysign(kInfinity, mantissa_ < 0 ? -1.0 : 1.0);
  return value;
}

Interval Decimal::enclosure() const {
  const auto narrow = static_cast<std::int64_t>(mantissa_);
  return narrow == mantissa_ ? Interval::of_decimal(narrow, exponent_) : Interval::of_decimal(text());
}

std::optional<int> Decimal::as_int() const {
  if (exponent_ < 0 || exponent_ > 9) return {};
  Wide value = mantissa_;
  for (int i = 0; i < exponent_; ++i) value *= 10;
  const bool fits = value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max() &&
                    (mantissa_ < 0 ? mantissa_ > -10'000'000'000 : mantissa_ < 10'000'000'000);
  return fits ? std::optional(static_cast<int>(value)) : std::nullopt;
}

std::optional<Decimal> add(const Decimal& a, const Decimal& b) {
  const Decimal& fine = a.exponent_ < b.exponent_ ? a : b;
  const Decimal& coarse = a.exponent_ < b.exponent_ ? b : a;
  if (coarse.exponent_ - fine.exponent_ > kMostDigits) return {};
  Decimal::Wide scaled = coarse.mantissa_;
  for (int e = coarse.exponent_; e > fine.exponent_; --e) {
    if (__builtin_mul_overflow(scaled, static_cast<Decimal::Wide>(10), &scaled)) return {};
  }
  if (__builtin_add_overflow(scaled, fine.mantissa_, &scaled)) return {};
  return Decimal::trimmed(scaled, fine.exponent_);
}

std::optional<Decimal> multiply(const Decimal& a, const Decimal& b) {
  Decimal::Wide product = 0;
  if (__builtin_mul_overflow(a.mantissa_, b.mantissa_, &product)) return {};
  if (std::abs(a.exponent_ + b.exponent_) > kLargestExponent) return {};
  return Decimal::trimmed(product, a.exponent_ + b.exponent_);
}

namespace {

// FNV-1a over words, each spread by the finalizer of MurmurHash3. Never 0.
class Identity {
 public:
  void add(std::uint64_t word) {
    word = (word ^ (word >> 33)) * 0xff51afd7ed558ccdU;
    word = (word ^ (word >> 33)) * 0xc4ceb9fe1a85ec53U;
    value_ = (value_ ^ word ^ (word >> 33)) * 0x100000001b3U;
  }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  [[nodiscard]] std::uint64_t value() const { return std::max<std::uint64_t>(value_, 1); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

Number Number::of(const Interval& enclosure, std::string_view function,
                  std::initializer_list<Number> arguments) {
  Identity identity;
  identity.add(function);
  for (const Number& argument : arguments) {
    if (argument.identity() == 0) return of(enclosure);
    identity.add(argument.identity());
  }
  return of(enclosure, identity.value());
}

std::uint64_t Number::identity() const {
  if (origin != 0 || (!exact && !enclosure.is_point())) return origin;
  Identity identity;
  if (exact) {
    identity.add(exact->text());
  } else {
    identity.add(std::bit_cast<std::uint64_t>(enclosure.lo()));
  }
  return identity.value();
}

std::optional<Number> Number::parse(std::string_view text) {
  if (const auto decimal = Decimal::parse(text)) return of(*decimal);
  if (!is_decimal(text)) return {};
  return of(Interval::of_decimal(text), text, {});
}

Number operator-(const Number& a) {
  return a.exact ? Number::of(a.exact->negated()) : Number::of(-a.enclosure, "-", {a});
}

Number operator+(const Number& a, const Number& b) {
  if (a.exact && b.exact) {
    if (const auto sum = add(*a.exact, *b.exact)) return Number::of(*sum);
  }
  return Number::of(a.enclosure + b.enclosure, "+", {a, b});
}

Number operator-(const Number& a, const Number& b) { return a + -b; }

Number operator*(const Number& a, const Number& b) {
  if (a.exact && b.exact) {
    if (const auto product = multiply(*a.exact, *b.exact)) return Number::of(*product);
  }
  return Number::of(a.enclosure * b.enclosure, "*", {a, b});
}

Number operator/(const Number& a, const Number& b) {
  return Number::of(a.enclosure / b.enclosure, "/", {a, b});
}

}  // namespace hcsp::lang
