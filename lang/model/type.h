// SPDX-License-Identifier: Apache-2.0
// The types of expressions.
#pragma once

#include <cstdint>
#include <string>

namespace hcsp::lang {

struct Symbol;

/// When the value of an expression is known: only by solving; once a function's arguments are; or now.
enum class Known : std::uint8_t { by_solving, at_call, now };

struct Type {
  enum class Kind : std::uint8_t {
    error,  ///< was reported: whatever is made of it is no further mistake
    boolean,
    real,    ///< a real (dim 0) or a vector
    domain,  ///< a set of values for an unknown: [a, b], m +- e, hold(...)
    set,     ///< a subset of R^dim
    column,  ///< a column of data, or a vector of columns
    table,
    text,
    range,  ///< 1..n
  };
  Kind kind = Kind::error;
  bool tube = false;      ///< varies with t
  std::uint32_t dim = 0;  ///< the number of components; 0 for a scalar
  Known known = Known::by_solving;
  const Symbol* data = nullptr;  ///< the table that a column belongs to

  [[nodiscard]] bool is_error() const { return kind == Kind::error; }
  [[nodiscard]] bool is(Kind k) const { return kind == k; }
  [[nodiscard]] bool is_scalar_real() const { return kind == Kind::real && dim == 0; }
  [[nodiscard]] std::uint32_t components() const { return dim == 0 ? 1 : dim; }
};

inline constexpr std::uint32_t kMostComponents = 10'000;

/// How a message calls a type: "tube real[2]", "a domain of real".
std::string describe(const Type& type);

}  // namespace hcsp::lang
