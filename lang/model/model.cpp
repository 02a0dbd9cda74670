// SPDX-License-Identifier: Apache-2.0
#include "lang/model/model.h"

#include <algorithm>

namespace hcsp::lang {

bool require_index(const Type& type, int index, const SourceRange& range, Diagnostics& diagnostics) {
  const Extent extent = index_range(type);
  if (index >= extent.first && index <= extent.last) return true;
  const Code code = type.is(Type::Kind::column) ? Code::row_outside : Code::index_outside;
  auto& diagnostic = diagnostics.report(code, range, index, extent.first, extent.last);
  if (index == 0 && extent.first == 1) diagnostic.note("indices start at 1");
  return false;
}

bool is_whole_range(const Binding& binding) {
  return binding.domain != nullptr && binding.domain->kind == ExprKind::binary &&
         binding.domain->op == Operator::range;
}

bool ranges_over_numbers(const Expr& expr) {
  return !expr.bindings.empty() && std::all_of(expr.bindings.begin(), expr.bindings.end(), is_whole_range);
}

const Expr& Model::unfold(const Expr& expr) const {
  const Expr* at = &expr;
  while (at->kind == ExprKind::name) {
    const Symbol* symbol = reference(*at).symbol;
    const LetItem* let = symbol == nullptr ? nullptr : symbol->as<LetItem>();
    if (let == nullptr) break;
    at = let->value;
  }
  return *at;
}

}  // namespace hcsp::lang
