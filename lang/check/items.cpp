// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/check/check.h"
#include "lang/check/checker.h"
#include "lang/data/file.h"

namespace hcsp::lang {

namespace {

std::string place_text(const SourceRange& range) {
  const auto place = range.source->position(range.begin);
  return fmt::format("{}:{}", range.source->name(), place.line);
}

}  // namespace

void check(Model& model, const std::map<std::string, std::string>& data_files) {
  Checker(model, data_files).run();
}

void Checker::run() {
  for (const Item& item : model_.tree().items) declare(item);
  for (Symbol& symbol : model_.symbols) ensure(symbol);
  for (const Item& item : model_.tree().items) {
    if (const auto* constraint = std::get_if<ConstraintItem>(&item.content)) check_constraint(*constraint);
    if (const auto* solve = std::get_if<SolveItem>(&item.content)) check_solve(*solve, item.range);
    if (const auto* show = std::get_if<ShowItem>(&item.content)) check_show(*show);
  }
}

// ---- Declarations.

void Checker::declare(const Item& item) {
  const auto once = [&](bool& seen, std::string_view word) {
    if (seen) diagnostics().report(Code::item_twice, item.range, word);
    seen = true;
  };
  if (const auto* model = std::get_if<ModelItem>(&item.content)) {
    once(model_seen_, "model");
    model_.name = model->name.text;
  } else if (std::holds_alternative<SolveItem>(item.content)) {
    once(solve_seen_, "solve");
  } else if (const auto* param = std::get_if<ParamItem>(&item.content)) {
    declare(param->name, param);
  } else if (const auto* data = std::get_if<DataItem>(&item.content)) {
    declare(data->name, data);
  } else if (const auto* time = std::get_if<TimeItem>(&item.content)) {
    bool seen = model_.time != nullptr;
    once(seen, "time");
    Symbol* symbol = declare(time->name, time);
    if (model_.time == nullptr) model_.time = symbol;
  } else if (const auto* function = std::get_if<FunctionItem>(&item.content)) {
    if (find_built_in(function->name.text) != nullptr) {
      diagnostics().report(Code::built_in_name, function->name.range, function->name.text);
    } else {
      declare(function->name, function);
    }
  } else if (const auto* given = std::get_if<GivenItem>(&item.content)) {
    declare(given->name, given);
  } else if (const auto* var = std::get_if<VarItem>(&item.content)) {
    for (const Name& name : var->names) declare(name, var);
  } else if (const auto* let = std::get_if<LetItem>(&item.content)) {
    declare(let->name, let);
  } else if (const auto* constraint = std::get_if<ConstraintItem>(&item.content)) {
    if (constraint->name) declare(*constraint->name, constraint);
  }
}

Symbol* Checker::declare(const Name& name, decltype(Symbol::item) item) {
  if (name.text == "pi") {
    diagnostics().report(Code::built_in_name, name.range, name.text);
    return nullptr;
  }
  const auto known = model_.by_name.find(name.text);
  if (known != model_.by_name.end()) {
    diagnostics()
        .report(Code::declared_twice, name.range, name.text)
        .note(fmt::format("first declared at {}", place_text(known->second->name.range)));
    return nullptr;
  }
  Symbol& symbol = model_.symbols.emplace_back();
  symbol.item = item;
  symbol.name = name;
  model_.by_name.emplace(name.text, &symbol);
  return &symbol;
}

void Checker::ensure(Symbol& symbol) {
  if (symbol.state == Symbol::State::done) return;
  if (symbol.state == Symbol::State::visiting) {
    const bool is_function = symbol.as<FunctionItem>() != nullptr;
    diagnostics().report(is_function ? Code::recursion : Code::cyclic_definition, symbol.name.range,
                         symbol.name.text);
    symbol.type = {};
    symbol.state = Symbol::State::done;
    return;
  }
  symbol.state = Symbol::State::visiting;
  // A definition sees nothing of the place that asks for it.
  std::vector<Visible> locals;
  std::swap(locals, locals_);
  const bool pointwise = std::exchange(pointwise_, false);
  std::vector<const Expr*> sides;
  std::swap(sides, sides_);
  const std::uint32_t instants = std::exchange(instants_to_find_, 0);
  const std::uint32_t ranges = std::exchange(ranges_, 0);
  check_symbol(symbol);
  ranges_ = ranges;
  std::swap(locals, locals_);
  pointwise_ = pointwise;
  std::swap(sides, sides_);
  symbol.takes_instants = instants_to_find_ != 0;
  instants_to_find_ = instants;
  symbol.state = Symbol::State::done;
}

void Checker::check_symbol(Symbol& symbol) {
  if (const auto* param = symbol.as<ParamItem>()) check_parameter(symbol, *param);
  if (const auto* data = symbol.as<DataItem>()) check_data(symbol, *data);
  if (const auto* time = symbol.as<TimeItem>()) check_time(symbol, *time);
  if (const auto* function = symbol.as<FunctionItem>()) check_function(symbol, *function);
  if (const auto* given = symbol.as<GivenItem>()) check_given(symbol, *given);
  if (const auto* var = symbol.as<VarItem>()) check_variable(symbol, *var);
  if (const auto* let = symbol.as<LetItem>()) check_let(symbol, *let);
}

// ---- Items.

void Checker::check_parameter(Symbol& symbol, const ParamItem& item) {
  const Type found = check(*item.value);
  if (symbol.state == Symbol::State::done || found.is_error()) return;  // a cycle was reported
  const bool may_be_open = model_.open_parameters.contains(symbol.name.text) && found.is(Type::Kind::real) &&
                           (found.is_scalar() || found.is_vector()) && !found.tube;
  if (may_be_open ? !require_parameters(*item.value) : !require_constant(*item.value, found)) return;
  Type wanted = found;
  if (item.type != nullptr) {
    wanted = resolve(*item.type);
    if (wanted.is_error() || !require_domain(*item.value, found, wanted)) return;
    if (wanted.tube || wanted.is(Type::Kind::set)) {
      not_supported(item.type->range, "a parameter of this type");
      return;
    }
    if (wanted.whole && found.is(Type::Kind::real) && !constants_.all_whole(*item.value)) return;
    if (wanted.is_array() && !found.has_shape_of(wanted)) {
      diagnostics().report(Code::wrong_type, item.value->range, describe(wanted), describe(found));
      return;
    }
  } else if (found.tube || (!found.is(Type::Kind::real) && !found.is(Type::Kind::domain) &&
                            !found.is(Type::Kind::boolean))) {
    diagnostics().report(Code::wrong_type, item.value->range, "a number, a vector or a domain",
                         describe(found));
    return;
  }
  symbol.open = may_be_open && wanted.has_shape_of(found) && !wanted.whole && !wanted.is(Type::Kind::boolean);
  symbol.unknown = found.is(Type::Kind::domain) || symbol.open;
  symbol.type = wanted;
  if (symbol.unknown) symbol.type.kind = Type::Kind::real;
  symbol.type.known = symbol.unknown ? Known::by_solving : Known::now;
  model_.definitions.push_back(&symbol);
}

// The value of an open parameter is made of constants and of other parameters.
bool Checker::require_parameters(const Expr& expr) {
  if (model_.type(expr).known == Known::now) return true;
  const Symbol* symbol = expr.kind == ExprKind::name ? model_.reference(expr).symbol : nullptr;
  const auto* let = symbol == nullptr ? nullptr : symbol->as<LetItem>();
  if (let != nullptr) return require_parameters(*let->value);
  const bool is_unknown = symbol != nullptr && !symbol->open && names_unknown(expr);
  if (is_unknown) diagnostics().report(Code::not_constant, expr.range);
  return !is_unknown && std::all_of(expr.operands.begin(), expr.operands.end(),
                                    [&](const Expr* operand) { return require_parameters(*operand); });
}

void Checker::check_data(Symbol& symbol, const DataItem& item) {
  const bool is_json = item.reader.text == "json";
  if (!is_json && item.reader.text != "csv") {
    diagnostics()
        .report(Code::unknown_function, item.reader.range, item.reader.text)
        .note("data is read by `csv` and `json`");
    return;
  }
  std::string path = beside(item.path.range.source->name(), std::string(item.path.text));
  SourceRange place = item.path.range;
  if (const auto replaced = data_files_.find(std::string(item.name.text)); replaced != data_files_.end()) {
    path = replaced->second;
    const Source& source = model_.tree().add_source(fmt::format("--data {}", item.name.text), path);
    place = {&source, 0, static_cast<std::uint32_t>(path.size())};
  }
  std::string error;
  auto text = read_file(path, error);
  if (!text) {
    diagnostics().report(Code::unreadable_data, place, path, error);
    return;
  }
  const Source& source = model_.tree().add_source(path, std::move(*text));
  auto table = is_json ? Table::read_json(source, diagnostics()) : Table::read_csv(source, diagnostics());
  if (!table) return;
  symbol.table = &model_.tables.emplace_back(std::move(*table));
  symbol.type = {Type::Kind::table, false, 0, Known::now, &symbol};
}

void Checker::check_time(Symbol& symbol, const TimeItem& item) {
  symbol.type = {Type::Kind::real, true, 0, Known::by_solving, nullptr};
  if (item.phases != nullptr) return check_phases(item);
  if (item.stamps != nullptr) {
    const Type type = check(*item.stamps);
    if (!type.is_error() && (!type.is(Type::Kind::column) || type.dim != 0)) {
      diagnostics().report(Code::wrong_type, item.stamps->range, "a column of stamps", describe(type));
    }
    return;
  }
  const Type span = check(*item.span);
  if (!span.is_error()) {
    if (!span.is(Type::Kind::domain) || span.dim != 0 || span.tube) {
      diagnostics().report(Code::wrong_type, item.span->range, "an interval `[start, end]`", describe(span));
    } else {
      require_constant(*item.span, span);
    }
  }
  const Type step = check(*item.step);
  if (!step.is_error() && require_scalar(*item.step, step)) require_constant(*item.step, step);
}

void Checker::check_function(Symbol& symbol, const FunctionItem& item) {
  const Type result = resolve(*item.type);
  symbol.first_local = next_local_;
  bool good = !result.is_error();
  for (const Parameter& parameter : item.parameters) {
    Type type = resolve(*parameter.type);
    if (type.tube || type.is(Type::Kind::set)) {
      type = not_supported(parameter.type->range, "a tube or a set as a parameter of a function");
    }
    good = good && !type.is_error();
    type.known = Known::at_call;
    symbol.parameters.push_back(type);
    bind(parameter.name.text, type);
  }
  next_local_ += static_cast<std::uint32_t>(item.locals.size());
  pointwise_ = true;  // at a call, the arguments are taken at one instant
  std::uint32_t id = symbol.first_local + static_cast<std::uint32_t>(item.parameters.size());
  for (const Local& local : item.locals) {
    const Type type = check(*local.value);
    locals_.push_back({local.name.text, id++, type});
  }
  const Type body = check(*item.body);
  if (!good || body.is_error() || symbol.state == Symbol::State::done) return;
  if (body.kind != result.kind || !body.has_shape_of(result)) {
    diagnostics().report(Code::wrong_type, item.body->range, describe(result), describe(body));
    return;
  }
  symbol.type = body;
  symbol.states = model_.is_stated(*item.body);
}

// A domain is a constant, or computed from the time alone, which the compiler sees.
void Checker::require_stated(const Expr& expr, const Type& found) {
  if (!found.tube) require_constant(expr, found);
}

void Checker::check_given(Symbol& symbol, const GivenItem& item) {
  const Type wanted = resolve(*item.type);
  symbol.type = wanted;
  const Type found = check(*item.value);
  if (wanted.is_error() || found.is_error() || !require_domain(*item.value, found, wanted)) return;
  if (wanted.is(Type::Kind::set)) {
    not_supported(item.value->range, "a given set");
  } else {
    require_stated(*item.value, found);
  }
}

void Checker::check_variable(Symbol& symbol, const VarItem& item) {
  const bool first = item.names.front().text == symbol.name.text;
  // The type and the domain of `var x, y : ...` are one text: its mistakes are told once.
  if (!first) {
    const auto leader = model_.by_name.find(item.names.front().text);
    if (leader != model_.by_name.end() && leader->second->as<VarItem>() == &item) {
      ensure(*leader->second);
      symbol.type = leader->second->type;
      return;
    }
  }
  const Type type = resolve(*item.type);
  if (item.precision != nullptr && !item.type->set) {
    diagnostics().report(Code::misplaced_precision, item.precision->range, describe(type));
  } else if (item.precision != nullptr) {
    const Type precision = check(*item.precision);
    if (!precision.is_error() && require_scalar(*item.precision, precision))
      require_constant(*item.precision, precision);
  } else if (type.is(Type::Kind::set)) {
    diagnostics().report(Code::no_precision, symbol.name.range, symbol.name.text);
  }
  if (item.domain != nullptr) {
    const Type domain = check(*item.domain);
    Type values = type;
    if (type.is(Type::Kind::set)) values.kind = Type::Kind::real;
    const bool fits = !type.is_error() && !domain.is_error() && require_domain(*item.domain, domain, values);
    if (fits) require_stated(*item.domain, domain);
  }
  symbol.type = type;
}

void Checker::check_let(Symbol& symbol, const LetItem& item) {
  const Type wanted = item.type == nullptr ? Type{} : resolve(*item.type);
  const Type found = check(*item.value);
  if (found.is_error() || symbol.state == Symbol::State::done) return;
  if (item.type != nullptr) {
    if (wanted.is_error()) return;
    if (found.kind != wanted.kind || !found.has_shape_of(wanted) || (found.tube && !wanted.tube)) {
      diagnostics().report(Code::wrong_type, item.value->range, describe(wanted), describe(found));
      return;
    }
  }
  symbol.type = found;
  model_.definitions.push_back(&symbol);
}

void Checker::check_constraint(const ConstraintItem& item) {
  const Type type = check(*item.relation);
  if (type.is_error()) return;
  if (type.is(Type::Kind::boolean)) {
    if (item.is_implied && model_.is_stated(*item.relation))
      not_supported(item.relation->range, "`implied` of more than a relation between numbers");
    if (item.is_of_family && model_.is_stated(*item.relation))
      not_supported(item.relation->range, "`family` of more than a relation between numbers");
    return;
  }
  diagnostics().report(Code::not_a_relation, item.relation->range, describe(type));
}

void Checker::check_solve(const SolveItem& item, const SourceRange& range) {
  model_.goal = &item;
  if (item.goal == SolveItem::Goal::propagate) {
    if (item.precision != nullptr) not_supported(range, "a precision of `solve propagate`");
    return;
  }
  if (item.goal == SolveItem::Goal::pave) {
    for (const Expr* paved : item.arguments) check_paved(*paved);
  }
  if (is_optimisation(item.goal)) {
    const Type objective = check(*item.arguments.front());
    if (!objective.is_error()) require_scalar(*item.arguments.front(), objective);
  }
  const Type precision = item.precision == nullptr ? Type{} : check(*item.precision);
  if (!precision.is_error() && require_scalar(*item.precision, precision))
    require_constant(*item.precision, precision);
}

// Whether an expression names an unknown, or a part of one.
bool Checker::names_unknown(const Expr& expr) const {
  const Expr& named = expr.kind == ExprKind::index ? *expr.operands[0] : expr;
  const Symbol* symbol = named.kind == ExprKind::name ? model_.reference(named).symbol : nullptr;
  return symbol != nullptr &&
         (symbol->as<VarItem>() != nullptr || symbol->as<GivenItem>() != nullptr || symbol->unknown);
}

void Checker::check_paved(const Expr& expr) {
  const Type type = check(expr);
  if (type.is_error()) return;
  if (!names_unknown(expr) || !type.is(Type::Kind::real) || type.tube)
    diagnostics().report(Code::not_paved, expr.range, expr.range.text().substr(0, 40));
}

void Checker::check_show(const ShowItem& item) {
  for (const Expr* shown : item.shown) {
    if (shown->kind != ExprKind::name) {
      not_supported(shown->range, "showing an expression");
      continue;
    }
    if (check_name(*shown).is_error()) continue;
    if (!names_unknown(*shown)) diagnostics().report(Code::not_shown, shown->range, shown->text);
  }
}

}  // namespace hcsp::lang
