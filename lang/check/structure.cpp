// SPDX-License-Identifier: Apache-2.0
#include "lang/check/structure.h"

#include <map>
#include <vector>

#include "lang/model/built_in.h"

namespace hcsp::lang {

namespace {

using Names = std::set<std::string_view>;

class Structure {
 public:
  explicit Structure(const SyntaxTree& tree) : tree_(tree) {
    for (const Item& item : tree.items) {
      if (const auto* param = std::get_if<ParamItem>(&item.content))
        definitions_[param->name.text] = param->value;
      if (const auto* let = std::get_if<LetItem>(&item.content)) definitions_[let->name.text] = let->value;
      if (const auto* function = std::get_if<FunctionItem>(&item.content))
        functions_[function->name.text] = function;
    }
  }

  /// The names that structure depends on, directly or through definitions.
  const Names& needed() {
    for (const Item& item : tree_.items)
      std::visit([&](const auto& content) { read(content); }, item.content);
    return needed_;
  }

 private:
  // Items.
  template <class Other>
  void read(const Other&) {}
  void read(const ParamItem& item) {
    read(item.type);
    if (item.type != nullptr && !may_be_open(*item.type)) need(item.name.text);
    read(item.value, false);
  }
  void read(const TimeItem& item) {
    const bool is_known = item.phases == nullptr;
    for (const Expr* part : {item.span, item.step, item.stamps, item.phases}) read(part, is_known);
  }
  void read(const FunctionItem& item) {
    for (const Parameter& parameter : item.parameters) read(parameter.type);
    read(item.type);
    read(item.body, false);
    for (const Local& local : item.locals) read(local.value, false);
  }
  void read(const GivenItem& item) {
    read(item.type);
    read(item.value, true);
  }
  void read(const VarItem& item) {
    read(item.type);
    read(item.domain, true);
    read(item.precision, true);
  }
  void read(const LetItem& item) {
    read(item.type);
    read(item.value, false);
  }
  void read(const ConstraintItem& item) { read(item.relation, false); }
  void read(const SolveItem& item) {
    for (const Expr* argument : item.arguments) read(argument, false);
    read(item.precision, true);
  }

  static bool may_be_open(const TypeExpr& type) {
    return type.base == TypeExpr::Base::real && type.arrays.empty() && type.sizes.size() <= 1;
  }
  void read(const TypeExpr* type) {
    if (type == nullptr) return;
    for (const Expr* size : type->sizes) read(size, true);
    for (const Expr* range : type->arrays) read(range, true);
  }

  // Expressions, of which structure depends on the value or not.
  void read(const Expr* expr, bool is_structure) {
    if (expr == nullptr) return;
    for (const Binding& binding : expr->bindings) {
      read(binding.type);
      read(binding.domain, true);
    }
    switch (expr->kind) {
      case ExprKind::name:
        if (is_structure) need(expr->text);
        return;
      case ExprKind::call:
        return read_call(*expr, is_structure);
      case ExprKind::index:
        return read_operands(*expr, is_structure, 1);
      case ExprKind::quantified:
        return read_operands(*expr, is_structure, 1);  // the count of an atleast
      case ExprKind::binary:
        if (expr->op == Operator::power) return read_operands(*expr, is_structure, 1);
        return read_operands(*expr, is_structure || expr->op == Operator::range, 2);
      default:
        return read_operands(*expr, is_structure, expr->operands.size());
    }
  }
  // Those from `first` on are structure in any case.
  void read_operands(const Expr& expr, bool is_structure, std::size_t first) {
    for (std::size_t i = 0; i < expr.operands.size(); ++i) read(expr.operands[i], is_structure || i >= first);
  }

  void read_call(const Expr& call, bool is_structure) {
    const Expr& callee = *call.operands[0];
    const auto function = callee.kind == ExprKind::name ? functions_.find(callee.text) : functions_.end();
    if (function != functions_.end()) {
      const Names& own = needed_by(*function->second);
      for (std::size_t i = 1; i < call.operands.size(); ++i) {
        const bool is_known = i <= function->second->parameters.size() &&
                              own.contains(function->second->parameters[i - 1].name.text);
        read(call.operands[i], is_structure || is_known);
      }
      return;
    }
    const BuiltInFunction* built_in = callee.kind == ExprKind::name ? find_built_in(callee.text) : nullptr;
    read(&callee, is_structure);
    for (std::size_t i = 1; i < call.operands.size(); ++i)
      read(call.operands[i], is_structure || (built_in == nullptr ? true : is_known(built_in->id, i)));
  }
  // Whether an argument of a built-in function has to be known. Of a tube it is an instant.
  static bool is_known(BuiltIn function, std::size_t argument) {
    switch (function) {
      case BuiltIn::zeros:
      case BuiltIn::gate:
      case BuiltIn::sampled:
        return true;
      case BuiltIn::root:
        return argument == 2;
      case BuiltIn::at_least:
        return argument == 1;
      default:
        return false;
    }
  }

  // What is structure in a function's body: of its parameters, too.
  const Names& needed_by(const FunctionItem& function) {
    const auto [known, is_new] = of_functions_.try_emplace(&function);
    if (!is_new) return known->second;
    Structure inside(*this);
    inside.needed_.clear();
    for (const Local& local : function.locals) inside.definitions_[local.name.text] = local.value;
    inside.read(function.body, false);
    return of_functions_[&function] = std::move(inside.needed_);
  }

  void need(std::string_view name) {
    if (!needed_.insert(name).second) return;
    const auto definition = definitions_.find(name);
    if (definition != definitions_.end()) read(definition->second, true);
  }

  const SyntaxTree& tree_;
  std::map<std::string_view, const Expr*> definitions_;
  std::map<std::string_view, const FunctionItem*> functions_;
  std::map<const FunctionItem*, Names> of_functions_;
  Names needed_;
};

}  // namespace

std::set<std::string_view> parameters_without_structure(const SyntaxTree& tree) {
  Structure structure(tree);
  const Names& needed = structure.needed();
  Names open;
  for (const Item& item : tree.items) {
    const auto* param = std::get_if<ParamItem>(&item.content);
    if (param != nullptr && !needed.contains(param->name.text)) open.insert(param->name.text);
  }
  return open;
}

}  // namespace hcsp::lang
