// SPDX-License-Identifier: Apache-2.0
// Interval literals (IEEE 1788-2015, 9.7 and 12.11): [l, u], [x], [empty], [entire], [nai], uncertain forms
// m?r, and a decoration after an underscore. Letters of either case; blanks are free within brackets.
#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "domains/check.h"
#include "domains/interval/decorated.h"
#include "domains/interval/interval.h"
#include "domains/interval/mpfr_scope.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return text;
}

bool is_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string_view without_sign(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return text;
}

/// A number of a literal, exactly as written.
struct Written {
  std::string_view number;
  std::string_view denominator;  // empty: none

  static std::optional<Written> read(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return Written{text, {}};
    const Written fraction{text.substr(0, slash), text.substr(slash + 1)};
    const bool good = is_digits(without_sign(fraction.number)) && is_digits(fraction.denominator) &&
                      fraction.denominator.find_first_not_of('0') != std::string_view::npos;
    return good ? std::optional(fraction) : std::nullopt;
  }

  /// Its nearest number of `precision` bits in a direction, rounded once: a fraction's parts are exact.
  void round(Number& result, mpfr_rnd_t direction) const {
    if (denominator.empty()) {
      const std::string text(without_sign(number));
      mpfr_strtofr(result.get(), std::string(number).c_str(), nullptr, text.starts_with("0x") ? 16 : 10,
                   direction);
      return;
    }
    const auto exact = [](std::string_view digits, Number& value) {
      mpfr_set_prec(value.get(), static_cast<mpfr_prec_t>(4 * digits.size() + 64));
      mpfr_strtofr(value.get(), std::string(digits).c_str(), nullptr, 10, MPFR_RNDN);
    };
    Number above(mpfr_prec_t{64}), below(mpfr_prec_t{64});
    exact(number, above);
    exact(denominator, below);
    mpfr_div(result.get(), above.get(), below.get(), direction);
  }

  [[nodiscard]] Interval enclosure() const {
    if (denominator.empty()) return Interval::of_decimal(number);
    RoundNearest guard;
    MpfrScope scope;
    Number bound(mpfr_prec_t{53});
    round(bound, MPFR_RNDD);
    const double lo = opaque(mpfr_get_d(bound.get(), MPFR_RNDD));
    round(bound, MPFR_RNDU);
    return Interval::raw(lo, opaque(mpfr_get_d(bound.get(), MPFR_RNDU)));
  }
};

/// Whether a is greater than b, as far as 4096 bits tell.
bool is_greater(const Written& a, const Written& b) {
  MpfrScope scope;
  Number x(mpfr_prec_t{4096}), y(mpfr_prec_t{4096});
  a.round(x, MPFR_RNDN);
  b.round(y, MPFR_RNDN);
  return mpfr_greater_p(x.get(), y.get()) != 0;
}

bool is_infinity(std::string_view text) {
  text = without_sign(text);
  return text == "inf" || text == "infinity";
}

/// The inside of the brackets of [l, u].
std::optional<Interval> bounds_of(std::string_view lower, std::string_view upper) {
  double lo = -kInfinity, hi = kInfinity;
  std::optional<Written> low, high;
  if (!lower.empty() && !is_infinity(lower)) {
    low = Written::read(lower);
    if (!low) return {};
    lo = low->enclosure().lo();
  } else if (!lower.empty() && lower.front() != '-') {
    return {};
  }
  if (!upper.empty() && !is_infinity(upper)) {
    high = Written::read(upper);
    if (!high) return {};
    hi = high->enclosure().hi();
  } else if (!upper.empty() && upper.front() == '-') {
    return {};
  }
  if (low && high && is_greater(*low, *high)) return {};
  return Interval::raw(lo, hi);
}

std::optional<Interval> bracketed(std::string_view inside) {
  inside = trimmed(inside);
  if (inside.empty() || inside == "empty") return Interval::empty();
  if (inside == "entire") return Interval::entire();
  const std::size_t comma = inside.find(',');
  if (comma != std::string_view::npos)
    return bounds_of(trimmed(inside.substr(0, comma)), trimmed(inside.substr(comma + 1)));
  const auto number = is_infinity(inside) ? std::nullopt : Written::read(inside);
  return number ? std::optional(number->enclosure()) : std::nullopt;
}

/// digits [. digits] as an integer and its places after the point, ten times each for the half unit of `?`.
struct Mantissa {
  std::string digits;
  std::size_t places = 0;
};

std::optional<Mantissa> mantissa_of(std::string_view text) {
  Mantissa mantissa;
  const std::string_view unsigned_text = without_sign(text);
  if (text.starts_with('-')) mantissa.digits = "-";
  const std::size_t point = std::min(unsigned_text.find('.'), unsigned_text.size());
  const std::string whole(unsigned_text.substr(0, point));
  const std::string fraction(point < unsigned_text.size() ? unsigned_text.substr(point + 1) : "");
  if (!is_digits(whole + fraction)) return {};
  mantissa.digits += whole + fraction + "0";
  mantissa.places = fraction.size() + 1;
  return mantissa;
}

/// m ? [r | ?] [u | d] [e exponent]: m give or take r units of its last place, half of one without r; `??`
/// has no limit.
std::optional<Interval> uncertain(std::string_view text) {
  const std::size_t mark = text.find('?');
  const auto mantissa = mantissa_of(text.substr(0, mark));
  if (!mantissa) return {};
  std::string_view rest = text.substr(mark + 1);
  const bool unlimited = rest.starts_with('?');
  if (unlimited) rest.remove_prefix(1);
  const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  if (unlimited && digits > 0) return {};
  const std::string radius = digits > 0 ? std::string(rest.substr(0, digits)) + "0" : "5";
  rest.remove_prefix(digits);
  const char direction = !rest.empty() && (rest.front() == 'u' || rest.front() == 'd') ? rest.front() : ' ';
  if (direction != ' ') rest.remove_prefix(1);
  long long exponent = 0;
  if (!rest.empty()) {
    if (rest.front() != 'e' || !is_digits(without_sign(rest.substr(1))) || rest.size() > 12) return {};
    exponent = std::stoll(std::string(rest.substr(1)));
  }
  const std::string scale = "e" + std::to_string(exponent - static_cast<long long>(mantissa->places));
  // m plus sign times r, exactly.
  const auto moved = [&](int sign) {
    MpfrScope scope;
    const auto bits = static_cast<mpfr_prec_t>(4 * (mantissa->digits.size() + radius.size()) + 64);
    Number value(bits), by(bits);
    mpfr_strtofr(value.get(), mantissa->digits.c_str(), nullptr, 10, MPFR_RNDN);
    mpfr_strtofr(by.get(), radius.c_str(), nullptr, 10, MPFR_RNDN);
    if (sign != 0) (sign > 0 ? mpfr_add : mpfr_sub)(value.get(), value.get(), by.get(), MPFR_RNDN);
    char* written = nullptr;
    mpfr_asprintf(&written, "%.0Rf", value.get());
    const std::string result = std::string(written) + scale;
    mpfr_free_str(written);
    return Interval::of_decimal(result);
  };
  const double lo = direction == 'u' ? moved(0).lo() : (unlimited ? -kInfinity : moved(-1).lo());
  const double hi = direction == 'd' ? moved(0).hi() : (unlimited ? kInfinity : moved(1).hi());
  return Interval::raw(lo, hi);
}

/// None when the text is no bare literal.
std::optional<Interval> bare(std::string_view text) {
  try {
    if (text.size() >= 2 && text.front() == '[' && text.back() == ']')
      return bracketed(text.substr(1, text.size() - 2));
    if (text.find('?') != std::string_view::npos) return uncertain(text);
  } catch (const std::invalid_argument&) {  // not a number, says of_decimal
  }
  return {};
}

/// Whether a bare literal's bounds are finite as written: they may be rounded to infinities all the same.
bool is_written_bounded(std::string_view text) {
  return text.find("inf") == std::string_view::npos && text.find("entire") == std::string_view::npos &&
         text.find("??") == std::string_view::npos && !trimmed(text.substr(1)).starts_with(',') &&
         !trimmed(text.substr(0, text.size() - 1)).ends_with(',');
}

std::optional<Decoration> decoration_of(std::string_view word) {
  if (word == "com") return Decoration::com;
  if (word == "dac") return Decoration::dac;
  if (word == "def") return Decoration::def;
  if (word == "trv") return Decoration::trv;
  return {};
}

}  // namespace

Interval Interval::of_text(std::string_view text) {
  const auto value = bare(trimmed(lower_case(text)));
  require(value.has_value(), "Interval::of_text: \"{}\" is not an interval", text);
  return *value;
}

DecoratedInterval DecoratedInterval::of_text(std::string_view text) {
  const std::string lower = lower_case(text);
  const std::string_view whole = trimmed(lower);
  const bool in_brackets = whole.size() >= 2 && whole.front() == '[' && whole.back() == ']';
  if (in_brackets && trimmed(whole.substr(1, whole.size() - 2)) == "nai") return nai();
  const std::size_t underscore = std::min(whole.rfind('_'), whole.size());
  const std::string_view literal = whole.substr(0, underscore);
  const auto value = bare(literal);
  require(value.has_value(), "DecoratedInterval::of_text: \"{}\" is not a decorated interval", text);
  const DecoratedInterval best(*value);
  if (underscore == whole.size()) return best;
  const auto decoration = decoration_of(whole.substr(underscore + 1));
  const bool is_bounded = !value->is_empty() && is_written_bounded(literal);
  require(decoration && *decoration <= (is_bounded ? Decoration::com : best.decoration()),
          "DecoratedInterval::of_text: \"{}\" cannot have this decoration", text);
  return {*value, std::min(*decoration, best.decoration())};
}

}  // namespace hcsp
