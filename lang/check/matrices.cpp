// SPDX-License-Identifier: Apache-2.0
// Functions that take or make matrices, and the cross product.
#include "lang/check/checker.h"

namespace hcsp::lang {

namespace {

// Minors of a matrix without numbers grow as 2^n.
constexpr std::uint32_t kLargestDeterminant = 10;

}  // namespace

Type Checker::check_matrix_function(const Expr& expr, const BuiltInFunction& function,
                                    const std::vector<Type>& arguments) {
  const Type& first = arguments[0];
  const auto wrong = [&](std::size_t i, std::string_view wanted) {
    diagnostics().report(Code::wrong_type, expr.operands[i + 1]->range, wanted, describe(arguments[i]));
    return Type{};
  };
  Type type = arguments.size() == 2 ? combined(Type::Kind::real, 0, first, arguments[1]) : first;
  type.whole = false;
  switch (function.id) {
    case BuiltIn::cross: {
      for (std::size_t i = 0; i < 2; ++i) {
        const bool fits = arguments[i].is(Type::Kind::real) && arguments[i].is_vector() &&
                          (arguments[i].dim == 2 || arguments[i].dim == 3);
        if (!fits) return wrong(i, "`real[2]` or `real[3]`");
      }
      if (first.dim != arguments[1].dim) {
        diagnostics().report(Code::sizes_differ, expr.range, describe(first), describe(arguments[1]));
        return {};
      }
      type.dim = first.dim == 3 ? 3 : 0;
      return type;
    }
    case BuiltIn::transpose:
      if (!first.is(Type::Kind::real) || !first.is_matrix() || first.is_array()) return wrong(0, "a matrix");
      std::swap(type.dim, type.columns);
      return type;
    case BuiltIn::det:
    case BuiltIn::inverse: {
      const bool is_square =
          first.is(Type::Kind::real) && first.is_matrix() && first.dim == first.columns && !first.is_array();
      if (!is_square) return wrong(0, "a square matrix");
      if (first.dim > kLargestDeterminant) {
        diagnostics().report(Code::bad_size, expr.operands[1]->range, kLargestDeterminant, first.dim);
        return {};
      }
      if (function.id == BuiltIn::det) type.dim = type.columns = 0;
      return type;
    }
    case BuiltIn::zeros: {
      type = {Type::Kind::real, false, 0, Known::now, nullptr};
      for (std::size_t k = 0; k < arguments.size(); ++k) {
        const auto size = size_of(*expr.operands[k + 1]);
        if (!size) return {};
        (k == 0 ? type.dim : type.columns) = *size;
      }
      if (type.components() <= kMostComponents) return type;
      diagnostics().report(Code::bad_size, expr.range, kMostComponents, type.components());
      return {};
    }
    default: {  // rot(angle), rot(axis, angle)
      const bool in_space = arguments.size() == 2;
      if (in_space && !(first.is(Type::Kind::real) && first.is_vector() && first.dim == 3))
        return wrong(0, "the axis, `real[3]`");
      if (!arguments.back().is_scalar_real()) return wrong(arguments.size() - 1, "an angle");
      type.dim = type.columns = in_space ? 3 : 2;
      return type;
    }
  }
}

}  // namespace hcsp::lang
