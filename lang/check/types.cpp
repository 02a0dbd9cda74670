// SPDX-License-Identifier: Apache-2.0
// Declared types, and whether a value may stand where one is declared.
#include <algorithm>

#include "lang/check/checker.h"

namespace hcsp::lang {

Type Checker::not_supported(const SourceRange& range, std::string_view what) {
  diagnostics().report(Code::not_supported, range, what);
  return {};
}

Type Checker::resolve(const TypeExpr& written) {
  const bool plain = written.sizes.empty() && !written.tube && !written.set;
  if (written.base != TypeExpr::Base::real && !plain) {
    diagnostics().report(Code::wrong_type, written.range, "`real` with a size, `tube` or `set`",
                         written.base == TypeExpr::Base::integer ? "`int`" : "`bool`");
    return {};
  }
  Type type{Type::Kind::real, written.tube, 0, Known::by_solving, nullptr};
  if (written.base == TypeExpr::Base::boolean) type.kind = Type::Kind::boolean;
  if (written.set) type.kind = Type::Kind::set;
  type.whole = written.base == TypeExpr::Base::integer;
  for (const Expr* range : written.arrays) {
    const auto extent = extent_of(*range);
    if (!extent) return {};
    type.arrays.push_back(*extent);
  }
  if (written.sizes.size() > 2) {
    diagnostics().report(Code::wrong_argument_count, written.range, "[]", "1 or 2 sizes",
                         written.sizes.size());
    return {};
  }
  for (std::size_t k = 0; k < written.sizes.size(); ++k) {
    const auto size = size_of(*written.sizes[k]);
    if (!size) return {};
    (k == 0 ? type.dim : type.columns) = *size;
  }
  if (type.is(Type::Kind::set) && (type.dim < 1 || type.dim > 3 || type.is_matrix())) {
    diagnostics().report(Code::bad_set_dimension, written.range, describe(type));
    return {};
  }
  if (type.is(Type::Kind::set) && model_.has_phases())
    return not_supported(written.range, "a set on a time line with phases");
  if (type.tube && model_.time == nullptr) {
    diagnostics().report(Code::no_time_line, written.range);
    return {};
  }
  double terms = 1;
  for (const std::size_t size : type.sizes()) terms *= static_cast<double>(size);
  if (terms > kMostComponents) {
    diagnostics().report(Code::bad_size, written.range, kMostComponents, terms);
    return {};
  }
  return type;
}

std::optional<std::uint32_t> Checker::size_of(const Expr& size) {
  const Type type = check(size);
  if (type.is_error() || !require_scalar(size, type) || !require_constant(size, type)) return {};
  const auto count = constants_.whole(size);
  if (!count) return {};
  if (*count < 1 || *count > static_cast<int>(kMostComponents)) {
    diagnostics().report(Code::bad_size, size.range, kMostComponents, *count);
    return {};
  }
  return static_cast<std::uint32_t>(*count);
}

std::optional<Extent> Checker::extent_of(const Expr& range) {
  if (range.kind != ExprKind::binary || range.op != Operator::range) {
    diagnostics().report(Code::wrong_type, range.range, "a range of whole numbers",
                         fmt::format("`{}`", range.range.text().substr(0, 40)));
    return {};
  }
  const Type type = check(range);
  if (type.is_error() || !require_constant(range, type)) return {};
  const auto extent = constants_.range(range);
  if (!extent) return {};
  const double count = static_cast<double>(extent->last) - extent->first + 1;
  if (count >= 1 && count <= kMostComponents) return extent;
  diagnostics().report(Code::bad_size, range.range, kMostComponents, count);
  return {};
}

bool Checker::require_domain(const Expr& value, const Type& found, const Type& wanted) {
  const bool is_value = found.is(Type::Kind::real) || found.is(Type::Kind::domain);
  const bool is_boolean = wanted.is(Type::Kind::boolean);
  const bool fits = (is_boolean ? found.is(Type::Kind::boolean) : is_value) && (wanted.tube || !found.tube);
  if (!fits) {
    diagnostics().report(Code::wrong_type, value.range, describe(wanted), describe(found));
    return false;
  }
  // A domain of one element serves all elements of an array.
  if (found.has_shape_of(wanted) || found.has_shape_of(wanted.element())) return true;
  auto& diagnostic = diagnostics().report(Code::wrong_type, value.range, describe(wanted), describe(found));
  if (value.kind == ExprKind::interval && wanted.is_vector())
    diagnostic.note(fmt::format("a box of equal sides is written `{}^{}`", value.range.text(), wanted.dim));
  return false;
}

bool Checker::require_constant(const Expr& expr, const Type& type) {
  if (type.known == Known::now) return true;
  diagnostics().report(Code::not_constant, expr.range);
  return false;
}

bool Checker::require_known(const Expr& expr, const Type& type) {
  if (type.known != Known::by_solving) return true;
  diagnostics().report(Code::not_constant, expr.range);
  return false;
}

bool Checker::require_scalar(const Expr& expr, const Type& type) {
  if (type.is_scalar_real() && !type.tube) return true;
  diagnostics().report(Code::wrong_type, expr.range, "a number", describe(type));
  return false;
}

std::uint32_t Checker::bind(std::string_view name, const Type& type) {
  locals_.push_back({name, next_local_, type});
  return next_local_++;
}

std::vector<std::string> Checker::visible_names() const {
  std::vector<std::string> names;
  for (const Visible& local : locals_) names.emplace_back(local.name);
  for (const Symbol& symbol : model_.symbols) names.emplace_back(symbol.name.text);
  names.emplace_back("pi");
  return names;
}

}  // namespace hcsp::lang
