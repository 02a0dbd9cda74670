// SPDX-License-Identifier: Apache-2.0
// The types of expressions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hcsp::lang {

struct Symbol;

/// When the value of an expression is known: only by solving; once a function's arguments are; once the names
/// that quantifiers bind to whole numbers have their values; or now.
enum class Known : std::uint8_t { by_solving, at_call, when_bound, now };

/// The indices first..last of an array.
struct Extent {
  int first = 1;
  int last = 0;
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(last - first + 1); }
  friend bool operator==(const Extent&, const Extent&) = default;
};

struct Type {
  enum class Kind : std::uint8_t {
    error,  ///< was reported: whatever is made of it is no further mistake
    boolean,
    real,    ///< a real (dim 0), a vector or a matrix; whole: an int
    domain,  ///< a set of values for an unknown: [a, b], m +- e, hold(...)
    set,     ///< a subset of R^dim
    column,  ///< a column of data, or a vector of columns
    table,
    text,
    range,  ///< 1..n
  };
  Kind kind = Kind::error;
  bool tube = false;      ///< varies with t
  std::uint32_t dim = 0;  ///< the number of components, or of rows; 0 for a scalar
  Known known = Known::by_solving;
  const Symbol* data = nullptr;     ///< the table that a column belongs to
  std::uint32_t columns = 0;        ///< of a matrix
  bool whole = false;               ///< a whole number
  std::vector<Extent> arrays = {};  ///< the index ranges of an array of these, outermost first

  [[nodiscard]] bool is_error() const { return kind == Kind::error; }
  [[nodiscard]] bool is(Kind k) const { return kind == k; }
  [[nodiscard]] bool is_array() const { return !arrays.empty(); }
  [[nodiscard]] bool is_matrix() const { return columns != 0; }
  [[nodiscard]] bool is_scalar() const { return dim == 0 && arrays.empty(); }
  [[nodiscard]] bool is_vector() const { return dim != 0 && columns == 0 && arrays.empty(); }
  [[nodiscard]] bool is_scalar_real() const { return kind == Kind::real && is_scalar(); }
  /// The numbers of components along each index, outermost first.
  [[nodiscard]] std::vector<std::size_t> sizes() const;
  [[nodiscard]] bool has_shape_of(const Type& other) const { return sizes() == other.sizes(); }
  /// Of one element of an array, or of the value if it is none.
  [[nodiscard]] std::size_t components() const;
  /// Of the whole value.
  [[nodiscard]] std::size_t terms() const;
  /// One element of an array.
  [[nodiscard]] Type element() const;
};

inline constexpr std::uint32_t kMostComponents = 1'000'000;

/// The indices that come first in `x[...]`, and what is left after one; for a type with components; the rows
/// of a column.
Extent index_range(const Type& type);
Type component_of(const Type& type);

/// How a message calls a type: "tube real[2]", "a domain of real".
std::string describe(const Type& type);

}  // namespace hcsp::lang
