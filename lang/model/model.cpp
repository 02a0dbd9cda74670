// SPDX-License-Identifier: Apache-2.0
#include "lang/model/model.h"

#include <fmt/format.h>

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

namespace {

// As a declaration writes it.
std::string spelled(const Type& type) {
  if (type.is(Type::Kind::boolean) && !type.is_array()) return type.tube ? "tube bool" : "bool";
  std::string text = describe(type);
  std::erase(text, '`');
  return text;
}

}  // namespace

std::string dump_types(const Model& model) {
  std::string text;
  for (const Symbol& symbol : model.symbols) {
    if (symbol.as<ConstraintItem>() != nullptr) continue;
    text += symbol.name.text;
    if (const auto* function = symbol.as<FunctionItem>()) {
      text += '(';
      for (std::size_t i = 0; i < symbol.parameters.size(); ++i) {
        text += i == 0 ? "" : ", ";
        text += fmt::format("{} : {}", function->parameters[i].name.text, spelled(symbol.parameters[i]));
      }
      text += ')';
    }
    text += fmt::format(" : {}\n", spelled(symbol.type));
  }
  return text;
}

}  // namespace hcsp::lang
