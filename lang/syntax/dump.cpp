// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "lang/syntax/ast.h"

namespace hcsp::lang {

namespace {

std::string dump(const TypeExpr* type) {
  if (type == nullptr) return "_";
  std::string text;
  for (const Expr* range : type->arrays) text += fmt::format("array[{}] of ", dump(*range));
  if (type->tube) text += "tube ";
  if (type->set) text += "set ";
  text += type->base == TypeExpr::Base::real      ? "real"
          : type->base == TypeExpr::Base::integer ? "int"
                                                  : "bool";
  for (std::size_t i = 0; i < type->sizes.size(); ++i) text += (i == 0 ? "[" : ", ") + dump(*type->sizes[i]);
  return type->sizes.empty() ? text : text + "]";
}

std::string dump_or_none(const Expr* expr) { return expr == nullptr ? "_" : dump(*expr); }

std::string operands(const Expr& expr, std::size_t from = 0) {
  std::string text;
  for (std::size_t i = from; i < expr.operands.size(); ++i) text.append(" ").append(dump(*expr.operands[i]));
  return text;
}

std::string bindings(const Expr& expr) {
  std::string text;
  for (const Binding& binding : expr.bindings) {
    text += text.empty() ? "" : " ";
    text += binding.name.text;
    if (binding.type != nullptr) text += fmt::format(" : {}", dump(binding.type));
    if (binding.domain != nullptr) text += fmt::format(" in {}", dump(*binding.domain));
  }
  return text;
}

struct ItemDump {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(const ModelItem& item) const { return fmt::format("(model {})", item.name.text); }
  std::string operator()(const IncludeItem& item) const {
    return fmt::format("(include \"{}\")", item.path.text);
  }
  std::string operator()(const ParamItem& item) const {
    return fmt::format("(param {} {} {})", item.name.text, dump(item.type), dump(*item.value));
  }
  std::string operator()(const DataItem& item) const {
    return fmt::format("(data {} {} \"{}\")", item.name.text, item.reader.text, item.path.text);
  }
  std::string operator()(const TimeItem& item) const {
    if (item.stamps != nullptr) return fmt::format("(time {} at {})", item.name.text, dump(*item.stamps));
    if (item.phases != nullptr) {
      return fmt::format("(time {} {} phases {})", item.name.text, dump(*item.span), dump(*item.phases));
    }
    return fmt::format("(time {} {} step {})", item.name.text, dump(*item.span), dump_or_none(item.step));
  }
  std::string operator()(const FunctionItem& item) const {
    std::string text = fmt::format("(function {} (", item.name.text);
    for (std::size_t i = 0; i < item.parameters.size(); ++i) {
      text += fmt::format("{}{} : {}", i == 0 ? "" : ", ", item.parameters[i].name.text,
                          dump(item.parameters[i].type));
    }
    text += fmt::format(") {} {}", dump(item.type), dump(*item.body));
    for (const Local& local : item.locals)
      text += fmt::format(" (where {} {})", local.name.text, dump(*local.value));
    return text + ")";
  }
  std::string operator()(const GivenItem& item) const {
    return fmt::format("(given {} {} {})", item.name.text, dump(item.type), dump(*item.value));
  }
  std::string operator()(const VarItem& item) const {
    std::string text = "(var";
    for (const Name& name : item.names) text += fmt::format(" {}", name.text);
    return text + fmt::format(" {} in {} precision {})", dump(item.type), dump_or_none(item.domain),
                              dump_or_none(item.precision));
  }
  std::string operator()(const LetItem& item) const {
    return fmt::format("(let {} {} {})", item.name.text, dump(item.type), dump(*item.value));
  }
  std::string operator()(const ConstraintItem& item) const {
    return fmt::format("({} {} {})",
                       item.is_implied     ? "implied"
                       : item.is_of_family ? "family"
                                           : "constraint",
                       item.name ? item.name->text : "_", dump(*item.relation));
  }
  std::string operator()(const SolveItem& item) const {
    const char* goals[] = {"propagate", "all", "pave", "minimize", "maximize"};
    std::string text = fmt::format("(solve {}", goals[static_cast<std::size_t>(item.goal)]);
    for (const Expr* argument : item.arguments) text.append(" ").append(dump(*argument));
    if (item.precision != nullptr) text += fmt::format(" precision {}", dump(*item.precision));
    return text + ")";
  }
  std::string operator()(const ShowItem& item) const {
    std::string text = "(show";
    for (const Expr* shown : item.shown) text.append(" ").append(dump(*shown));
    return text + ")";
  }
};

}  // namespace

std::string dump(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::number:
    case ExprKind::infinity:
    case ExprKind::boolean:
    case ExprKind::name:
      return std::string(expr.text);
    case ExprKind::string:
      return fmt::format("\"{}\"", expr.text);
    case ExprKind::member:
      return fmt::format("(.{} \"{}\")", operands(expr), expr.text);
    case ExprKind::index:
      return fmt::format("(index{})", operands(expr));
    case ExprKind::call:
      return fmt::format("(call{})", operands(expr));
    case ExprKind::unary:
    case ExprKind::binary:
      return fmt::format("({}{})", spelling(expr.op), operands(expr));
    case ExprKind::tuple:
      return fmt::format("(tuple{})", operands(expr));
    case ExprKind::interval:
      return fmt::format("(interval{})", operands(expr));
    case ExprKind::builder:
      return fmt::format("(set ({}){})", bindings(expr), operands(expr));
    case ExprKind::quantified:
      return fmt::format("({} ({}){})", spelling(expr.quantifier), bindings(expr), operands(expr));
    case ExprKind::comprehension:
      return fmt::format("(for ({}){})", bindings(expr), operands(expr));
    case ExprKind::conditional:
      return fmt::format("(if{})", operands(expr));
  }
  return {};
}

std::string dump(const SyntaxTree& tree) {
  std::string text;
  for (const Item& item : tree.items) text += std::visit(ItemDump{}, item.content) + "\n";
  return text;
}

}  // namespace hcsp::lang
