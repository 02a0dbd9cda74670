// SPDX-License-Identifier: Apache-2.0
// Declared types, and whether a value may stand where one is declared.
#include <algorithm>

#include "lang/check/checker.h"

namespace hcsp::lang {

Type Checker::not_supported(const SourceRange& range, std::string_view what) {
  diagnostics().report(Code::not_supported, range, what);
  return {};
}

bool Checker::refuse_kind(const TypeExpr& type, std::string_view what) {
  if (type.base == TypeExpr::Base::real) return false;
  not_supported(type.range,
                fmt::format("{} of type {}", what, type.base == TypeExpr::Base::integer ? "int" : "bool"));
  return true;
}

Type Checker::resolve(const TypeExpr& written) {
  if (!written.arrays.empty()) return not_supported(written.range, "an array");
  if (written.sizes.size() > 1) return not_supported(written.range, "a matrix");
  const bool plain = written.sizes.empty() && !written.tube && !written.set;
  if (written.base != TypeExpr::Base::real && !plain) return not_supported(written.range, "this type");
  Type type{Type::Kind::real, written.tube, 0, Known::by_solving, nullptr};
  if (written.base == TypeExpr::Base::boolean) type.kind = Type::Kind::boolean;
  if (written.set) type.kind = Type::Kind::set;
  if (!written.sizes.empty()) {
    const Expr& size = *written.sizes.front();
    const Type size_type = check(size);
    if (size_type.is_error() || !require_scalar(size, size_type) || !require_constant(size, size_type))
      return {};
    const auto count = constants_.whole(size);
    if (!count) return {};
    if (*count < 1 || *count > static_cast<int>(kMostComponents)) {
      diagnostics().report(Code::bad_size, size.range, kMostComponents, *count);
      return {};
    }
    type.dim = static_cast<std::uint32_t>(*count);
  }
  if (type.is(Type::Kind::set) && (type.dim < 1 || type.dim > 3)) {
    diagnostics().report(Code::bad_set_dimension, written.range, describe(type));
    return {};
  }
  if (type.tube && model_.time == nullptr) {
    diagnostics().report(Code::no_time_line, written.range);
    return {};
  }
  return type;
}

bool Checker::require_domain(const Expr& value, const Type& found, const Type& wanted) {
  const bool is_value = found.is(Type::Kind::real) || found.is(Type::Kind::domain);
  const bool fits = is_value && !wanted.is(Type::Kind::boolean) && (wanted.tube || !found.tube);
  if (!fits) {
    diagnostics().report(Code::wrong_type, value.range, describe(wanted), describe(found));
    return false;
  }
  if (found.dim != wanted.dim) {
    auto& diagnostic = diagnostics().report(Code::wrong_type, value.range, describe(wanted), describe(found));
    if (value.kind == ExprKind::interval) {
      diagnostic.note(fmt::format("a box of equal sides is written `{}^{}`", value.range.text(), wanted.dim));
    }
    return false;
  }
  return true;
}

bool Checker::require_constant(const Expr& expr, const Type& type) {
  if (type.known == Known::now) return true;
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
