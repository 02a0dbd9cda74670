// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/compiler.h"

#include <algorithm>

#include "lang/model/type.h"

namespace hcsp::lang::minibex {

std::unique_ptr<Problem> Compiler::run() {
  for (const Function& function : program_.functions) is_new(function.name);
  for (const Declaration& declaration : program_.constants) constant(declaration);
  for (const Declaration& declaration : program_.variables) {
    if (!is_new(declaration.name)) continue;
    variables_.names.emplace(declaration.name.text, Binding{});
    const auto shape = evaluator_.shape(declaration);
    if (shape && has_room(declaration, *shape)) shapes_.emplace(declaration.name.text, *shape);
  }
  if (diagnostics_.any()) return nullptr;
  number_components();
  for (const Declaration& declaration : program_.variables) variable(declaration);
  if (diagnostics_.any()) return nullptr;
  evaluator_.within(variables_, [&] {
    goal();
    return state(program_.constraints);
  });
  return diagnostics_.any() ? nullptr : std::move(problem_);
}

bool Compiler::is_new(const Name& name) {
  if (declared_.insert(name.text).second) return true;
  diagnostics_.report(Code::declared_twice, name.range, name.text);
  return false;
}

// All sizes together are bounded.
bool Compiler::has_room(const Declaration& declaration, const Shape& shape) {
  components_ += shape.first * shape.second;
  if (components_ <= kMostComponents) return true;
  diagnostics_.report(Code::bad_size, declaration.name.range, kMostComponents, components_);
  return false;
}

void Compiler::add_type(const Name& name, const Shape& shape, std::string_view what) {
  const auto& [rows, columns] = shape;
  const std::string size = columns > 1 ? fmt::format("[{}, {}]", rows, columns)
                           : rows > 1  ? fmt::format("[{}]", rows)
                                       : "";
  types_ += fmt::format("{} : {}{}\n", name.text, what, size);
}

// The value in the shape of a declaration: a number stands for all components.
Tensor Compiler::spread(const Declaration& declaration, const Shape& shape, const Tensor& value) {
  const auto& [rows, columns] = shape;
  if (value.failed() || (value.rows == rows && value.columns == columns)) return value;
  if (value.is_scalar()) return {rows, columns, Value(rows * columns, value.terms.front())};
  auto& diagnostic = diagnostics_.report(Code::sizes_differ, declaration.value->range,
                                         describe(Tensor(rows, columns, {})), describe(value));
  if (value.rows == columns && value.columns == rows)
    diagnostic.note("(a; b) is a vector, the row (a, b) is declared x[1][2]");
  return {};
}

// ---- Constants.

void Compiler::constant(const Declaration& declaration) {
  if (!is_new(declaration.name)) return;
  Binding& binding = evaluator_.constants().names[declaration.name.text];
  const auto shape = evaluator_.shape(declaration);
  if (!shape || !has_room(declaration, *shape)) return;
  const Tensor known = evaluator_.constant(*declaration.value);
  const bool is_interval = evaluator_.made_of_intervals();
  Tensor value = spread(declaration, *shape, known);
  if (value.failed()) return;
  add_type(declaration.name, *shape, is_interval ? "constant interval" : "constant real");
  if (!is_interval) {
    binding.value = std::move(value);
    return;
  }
  binding.interval = std::move(value);
  Tensor unknown = evaluator_.value(*declaration.value);
  while (!unknown.failed() && unknown.terms.size() < shape->first * shape->second) {
    // One interval for all components: an unknown each.
    const Tensor another = evaluator_.value(*declaration.value);
    if (another.failed()) return;
    unknown.terms.push_back(another.terms.front());
  }
  if (!unknown.failed()) binding.value = {shape->first, shape->second, std::move(unknown.terms)};
}

// ---- Variables.

std::optional<Box> Compiler::domain(const Declaration& declaration, const Shape& shape) {
  Box box(static_cast<Eigen::Index>(shape.first * shape.second));
  if (declaration.value == nullptr) return box;
  const Tensor stated = spread(declaration, shape, evaluator_.constant(*declaration.value));
  if (stated.failed()) return {};
  for (std::size_t i = 0; i < stated.terms.size(); ++i)
    box[static_cast<Eigen::Index>(i)] = std::get<Number>(stated.terms[i]).enclosure;
  return box;
}

void Compiler::variable(const Declaration& declaration) {
  const Shape& shape = shapes_.at(declaration.name.text);
  const auto box = domain(declaration, shape);
  if (!box) return;
  std::size_t whole = 0;
  const std::size_t components = shape.first * shape.second;
  for (std::size_t i = 0; i < components; ++i) whole += is_whole(declaration, i) ? 1 : 0;
  add_type(declaration.name, shape, whole == components ? "int" : "real");
  variables_.names[declaration.name.text].value =
      whole > 0 ? make_numbers(declaration, shape, *box) : make(declaration, shape, *box);
}

Tensor Compiler::make(const Declaration& declaration, const Shape& shape, const Box& domain) {
  std::string name(declaration.name.text);
  const auto& [rows, columns] = shape;
  if (domain.dim() == 1) return Term((*problem_)(problem_->real(std::move(name), domain[0])));
  const VectorVariable made = columns == 1 ? problem_->vector(std::move(name), domain)
                                           : problem_->matrix(std::move(name), rows, domain);
  const VectorExpr components = (*problem_)(made);
  return {rows, columns, Value(components.begin(), components.end())};
}

// With whole numbers among the components a variable is an array of numbers.
Tensor Compiler::make_numbers(const Declaration& declaration, const Shape& shape, const Box& domain) {
  const std::string name(declaration.name.text);
  const auto& [rows, columns] = shape;
  Tensor made(rows, columns, {});
  for (std::size_t i = 0; i < rows * columns; ++i) {
    std::vector<int> indices{static_cast<int>(i / columns) + 1};
    if (columns > 1) indices.push_back(static_cast<int>(i % columns) + 1);
    const bool is_alone = rows * columns == 1;
    const std::string own = is_alone ? name : fmt::format("{}[{}]", name, fmt::join(indices, ", "));
    const Interval& values = domain[static_cast<Eigen::Index>(i)];
    VariableId id = 0;
    if (is_whole(declaration, i)) {
      const IntegerVariable number = problem_->integer(own, values);
      id = number.id;
      made.terms.emplace_back((*problem_)(number));
      whole_nodes_.insert(std::get<hcsp::Expr>(made.terms.back()).node());
    } else {
      const RealVariable number = problem_->real(own, values);
      id = number.id;
      made.terms.emplace_back((*problem_)(number));
    }
    if (!is_alone) problem_->place_in_array(id, name, std::move(indices));
  }
  return made;
}

// ---- Whole numbers.

// With every component standing for its place, integer(x(i)) tells which component it speaks of.
void Compiler::number_components() {
  for (const auto& [name, shape] : shapes_) {
    Tensor places(shape.first, shape.second, {});
    for (std::size_t i = 0; i < shape.first * shape.second; ++i)
      places.terms.push_back(Evaluator::counted(static_cast<int>(i)).terms.front());
    variables_.names[name].value = std::move(places);
  }
  evaluator_.within(variables_, [&] { return find_whole(program_.constraints); });
}

bool Compiler::find_whole(const std::vector<Statement>& statements) {
  return std::all_of(statements.begin(), statements.end(), [&](const Statement& statement) {
    if (const auto* loop = std::get_if<Loop>(&statement.content)) {
      return !has_integrality(*loop) || evaluator_.for_each(*loop->first, *loop->last, loop->iterator,
                                                            [&] { return find_whole(loop->body); });
    }
    const auto* integrality = std::get_if<Integrality>(&statement.content);
    const Name* variable = integrality == nullptr ? nullptr : variable_in(*integrality->argument);
    if (variable == nullptr) return true;
    const Tensor places = evaluator_.constant(*integrality->argument);
    for (const Term& place : places.terms)
      whole_.emplace(variable->text, static_cast<std::size_t>(*whole_value(std::get<Number>(place))));
    return !places.failed();
  });
}

bool Compiler::has_integrality(const Loop& loop) const {
  return std::any_of(loop.body.begin(), loop.body.end(), [&](const Statement& statement) {
    const auto* inner = std::get_if<Loop>(&statement.content);
    return inner != nullptr ? has_integrality(*inner)
                            : std::holds_alternative<Integrality>(statement.content);
  });
}

// The variable that an expression is, or is a part of; null where it is neither.
const Name* Compiler::variable_in(const Expr& expr) const {
  const Expr* base = &expr;
  while (base->kind == Kind::apply) base = base->operands[0];
  if (base->kind != Kind::name) return nullptr;
  const auto found =
      std::find_if(program_.variables.begin(), program_.variables.end(),
                   [&](const Declaration& variable) { return variable.name.text == base->text; });
  return found == program_.variables.end() ? nullptr : &found->name;
}

bool Compiler::is_whole(const Declaration& variable, std::size_t component) const {
  return variable.whole || whole_.contains({variable.name.text, component});
}

}  // namespace hcsp::lang::minibex
