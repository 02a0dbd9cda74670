// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/interpreter.h"

#include <functional>

namespace hcsp::verifier {

namespace {

const std::map<std::string, Operation> kOperators = {
    {"+", Operation::add}, {"-", Operation::subtract}, {"*", Operation::multiply}, {"/", Operation::divide}};
const std::map<std::string, Operation> kFunctions = {{"sqrt", Operation::sqrt}, {"exp", Operation::exp},
                                                     {"log", Operation::log},   {"sin", Operation::sin},
                                                     {"cos", Operation::cos},   {"atan", Operation::atan}};

}  // namespace

Value Interpreter::known(Precise constant) {
  return number(system_.expressions.constant(std::move(constant)));
}

Value Interpreter::number(std::size_t node) const {
  Value value;
  value.node = node;
  return value;
}

const Precise* Interpreter::constant(const Value& value) const {
  const Node& node = system_.expressions.nodes().at(value.node);
  return value.kind == Value::Kind::number && node.operation == Operation::constant ? &node.value : nullptr;
}

long Interpreter::whole(const Tree& tree, const Names& names) {
  const Value index = value(tree, names);
  const Precise* number = constant(index);
  if (number == nullptr || !number->is_point()) throw Unreadable(tree.line, "expected a whole constant");
  return static_cast<long>(number->middle());
}

std::pair<long, long> Interpreter::range(const Tree& tree, const Names& names) {
  if (tree.head != "..") throw Unreadable(tree.line, "expected a range");
  return {whole(tree.parts[0], names), whole(tree.parts[1], names)};
}

std::vector<std::pair<Value, Value>> Interpreter::domain(const Tree& tree, std::size_t count) {
  std::vector<std::pair<Value, Value>> sides;
  if (tree.head == "interval") {
    sides.assign(count, {value(tree.parts.at(0)), value(tree.parts.at(1))});
  } else if (tree.head == "^") {
    return domain(tree.parts[0], count);
  } else if (tree.head == "vector" && tree.parts.size() == count) {
    for (const Tree& part : tree.parts) sides.push_back(domain(part, 1).front());
  } else {
    throw Unreadable(tree.line, "expected a domain");
  }
  return sides;
}

void Interpreter::declare(const std::string& name, const std::vector<std::pair<long, long>>& ranges,
                          const Tree& tree) {
  std::size_t count = 1;
  for (const auto& [first, last] : ranges) count *= static_cast<std::size_t>(last - first + 1);
  std::size_t next = system_.domains().size();
  Declaration declaration{name, {}};
  for (const auto& [low, high] : domain(tree, count)) {
    const Precise *a = constant(low), *b = constant(high);
    if (a == nullptr || b == nullptr) throw Unreadable(tree.line, "expected a constant domain");
    declaration.domains.push_back(Precise::hull(*a, *b));
  }
  system_.declarations.push_back(std::move(declaration));
  const std::function<Value(std::size_t)> unknowns = [&](std::size_t level) {
    if (level == ranges.size()) return number(system_.expressions.unknown(next++));
    Value vector;
    vector.kind = Value::Kind::vector;
    vector.first = ranges[level].first;
    for (long i = ranges[level].first; i <= ranges[level].second; ++i)
      vector.parts.push_back(unknowns(level + 1));
    return vector;
  };
  globals_[name] = unknowns(0);
}

void Interpreter::constrain(const Tree& tree) {
  const Value said = value(tree);
  if (said.kind == Value::Kind::truth && said.truth) return;
  if (said.kind != Value::Kind::relations) throw Unreadable(tree.line, "expected a relation");
  system_.relations.insert(system_.relations.end(), said.relations.begin(), said.relations.end());
}

Value Interpreter::value(const Tree& tree, const Names& names) {
  const auto part = [&](std::size_t i) { return value(tree.parts.at(i), names); };
  if (tree.head == "number") return known(Precise::decimal(tree.text));
  if (tree.head == "name") {
    if (const auto found = names.find(tree.text); found != names.end()) return found->second;
    if (const auto found = globals_.find(tree.text); found != globals_.end()) return found->second;
    if (tree.text == "pi") return known(Precise::pi());
    throw Unreadable(tree.line, "unknown name " + tree.text);
  }
  if (tree.head == "index") return element(part(0), tree, names);
  if (tree.head == "call") return call(tree, names);
  if (tree.head == "if") {
    const Value condition = part(0);
    if (condition.kind != Value::Kind::truth)
      throw Unreadable(tree.line, "expected a condition on constants");
    return part(condition.truth ? 1 : 2);
  }
  if (tree.head == "vector") {
    Value vector;
    vector.kind = Value::Kind::vector;
    for (std::size_t i = 0; i < tree.parts.size(); ++i) vector.parts.push_back(part(i));
    return vector;
  }
  if (tree.head == "negate") return product(tree, known(Precise(-1.0)), part(0));
  if (tree.head == "^") {
    const Value base = part(0);
    return number(system_.expressions.power(base.node, whole(tree.parts[1], names)));
  }
  if (tree.head == "each" || tree.head == "sum" || tree.head == "prod" || tree.head == "forall")
    return over_bounds(tree, names);
  if (kOperators.contains(tree.head)) return arithmetic(tree, part(0), part(1));
  return relation(tree, names);
}

Value Interpreter::arithmetic(const Tree& tree, const Value& a, const Value& b) {
  if (tree.head == "*") return product(tree, a, b);
  if (a.kind == Value::Kind::vector) {
    const bool is_pairwise = b.kind == Value::Kind::vector && b.parts.size() == a.parts.size();
    if (!is_pairwise && tree.head != "/") throw Unreadable(tree.line, "operands of different sizes");
    Value vector = a;
    for (std::size_t i = 0; i < a.parts.size(); ++i)
      vector.parts[i] = arithmetic(tree, a.parts[i], tree.head == "/" ? b : b.parts[i]);
    return vector;
  }
  if (a.kind != Value::Kind::number || b.kind != Value::Kind::number)
    throw Unreadable(tree.line, "expected numbers");
  return number(system_.expressions.apply(kOperators.at(tree.head), a.node, b.node));
}

/// Of numbers, and of a number and a vector.
Value Interpreter::product(const Tree& tree, const Value& a, const Value& b) {
  if (a.kind == Value::Kind::vector && b.kind == Value::Kind::number) return product(tree, b, a);
  if (a.kind != Value::Kind::number) throw Unreadable(tree.line, "expected a number as a factor");
  if (b.kind == Value::Kind::vector) {
    Value vector = b;
    for (Value& part : vector.parts) part = product(tree, a, part);
    return vector;
  }
  if (b.kind != Value::Kind::number) throw Unreadable(tree.line, "expected a number as a factor");
  return number(system_.expressions.apply(Operation::multiply, a.node, b.node));
}

Value Interpreter::element(Value of, const Tree& tree, const Names& names) {
  for (std::size_t i = 1; i < tree.parts.size(); ++i) {
    const long at = whole(tree.parts[i], names) - of.first;
    if (of.kind != Value::Kind::vector || at < 0 || at >= static_cast<long>(of.parts.size()))
      throw Unreadable(tree.line, "an index out of range");
    Value part = of.parts[static_cast<std::size_t>(at)];
    of = std::move(part);
  }
  return of;
}

Value Interpreter::call(const Tree& tree, const Names& names) {
  std::vector<Value> arguments;
  for (const Tree& part : tree.parts) arguments.push_back(value(part, names));
  const auto found = functions_.find(tree.text);
  if (found == functions_.end()) return built_in(tree, arguments);
  const Function& function = found->second;
  Names local;
  for (std::size_t i = 0; i < function.parameters.size(); ++i)
    local[function.parameters[i]] = arguments.at(i);
  for (const auto& [name, tree_of] : function.locals) local[name] = value(tree_of, local);
  return value(function.value, local);
}

Value Interpreter::built_in(const Tree& tree, const std::vector<Value>& arguments) {
  const Value& a = arguments.at(0);
  Expressions& expressions = system_.expressions;
  if (tree.text == "sum" || tree.text == "prod") {
    const bool is_sum = tree.text == "sum";
    Value total = known(Precise(is_sum ? 0.0 : 1.0));
    for (const Value& part : a.parts)
      total.node = expressions.apply(is_sum ? Operation::add : Operation::multiply, total.node, part.node);
    return total;
  }
  if (tree.text == "dot" || (tree.text == "norm" && a.kind == Value::Kind::vector)) {
    const Value& b = arguments.back();
    Value total = known(Precise(0.0));
    for (std::size_t i = 0; i < a.parts.size(); ++i) {
      const std::size_t square = tree.text == "norm" ? expressions.power(a.parts[i].node, 2)
                                                     : product(tree, a.parts[i], b.parts.at(i)).node;
      total.node = expressions.apply(Operation::add, total.node, square);
    }
    return tree.text == "dot" ? total : number(expressions.apply(Operation::sqrt, total.node));
  }
  if (tree.text == "sqr") return number(expressions.power(a.node, 2));
  const auto found = kFunctions.find(tree.text);
  if (found == kFunctions.end() || a.kind != Value::Kind::number)
    throw Unreadable(tree.line, "unknown function " + tree.text);
  return number(expressions.apply(found->second, a.node));
}

Value Interpreter::over_bounds(const Tree& tree, const Names& names) {
  const std::size_t bounds = tree.parts.size() - 1;
  Value total;
  if (tree.head == "each") total.kind = Value::Kind::vector;
  if (tree.head == "forall") total.kind = Value::Kind::relations;
  if (tree.head == "sum") total = known(Precise(0.0));
  if (tree.head == "prod") total = known(Precise(1.0));
  const std::function<void(std::size_t, Names&)> add = [&](std::size_t at, Names& inner) {
    if (at < bounds) {
      const auto [first, last] = range(tree.parts[at].parts[0], inner);
      for (long i = first; i <= last; ++i) {
        inner[tree.parts[at].text] = known(Precise(static_cast<double>(i)));
        add(at + 1, inner);
      }
      return;
    }
    const Value each = value(tree.parts.back(), inner);
    if (tree.head == "each") total.parts.push_back(each);
    if (tree.head == "forall") total = both(tree, total, each);
    if (tree.head == "sum") total = number(system_.expressions.apply(Operation::add, total.node, each.node));
    if (tree.head == "prod")
      total = number(system_.expressions.apply(Operation::multiply, total.node, each.node));
  };
  Names inner = names;
  add(0, inner);
  return total;
}

Value Interpreter::both(const Tree& tree, const Value& a, const Value& b) const {
  if (a.kind == Value::Kind::truth && b.kind == Value::Kind::truth) {
    Value value = a;
    value.truth = a.truth && b.truth;
    return value;
  }
  if (a.kind == Value::Kind::truth && a.truth) return b;
  if (b.kind == Value::Kind::truth && b.truth) return a;
  if (a.kind != Value::Kind::relations || b.kind != Value::Kind::relations)
    throw Unreadable(tree.line, "expected relations");
  Value value = a;
  value.relations.insert(value.relations.end(), b.relations.begin(), b.relations.end());
  return value;
}

Value Interpreter::relation(const Tree& tree, const Names& names) {
  if (tree.head == "and") return both(tree, value(tree.parts[0], names), value(tree.parts[1], names));
  if (tree.head == "not" || tree.head == "or") {
    Value a = value(tree.parts[0], names), b = value(tree.parts.back(), names);
    if (a.kind != Value::Kind::truth || b.kind != Value::Kind::truth)
      throw Unreadable(tree.line, tree.head + " is understood of constants only");
    a.truth = tree.head == "not" ? !a.truth : a.truth || b.truth;
    return a;
  }
  if (tree.head == "in" && tree.parts[1].head == "interval") {
    const Value a = value(tree.parts[0], names);
    const Tree& side = tree.parts[1];
    return both(tree, compared(tree, ">=", a, value(side.parts.at(0), names)),
                compared(tree, "<=", a, value(side.parts.at(1), names)));
  }
  return compared(tree, tree.head, value(tree.parts.at(0), names), value(tree.parts.at(1), names));
}

Value Interpreter::compared(const Tree& tree, const std::string& sign, const Value& a, const Value& b) {
  Value result;
  result.kind = Value::Kind::relations;
  if (a.kind == Value::Kind::vector && b.kind == Value::Kind::vector) {
    if (a.parts.size() != b.parts.size()) throw Unreadable(tree.line, "vectors of different sizes");
    for (std::size_t i = 0; i < a.parts.size(); ++i)
      result = both(tree, result, compared(tree, sign, a.parts[i], b.parts[i]));
    return result;
  }
  if (a.kind != Value::Kind::number || b.kind != Value::Kind::number)
    throw Unreadable(tree.line, "expected numbers");
  if (sign == ">" || sign == ">=") return compared(tree, sign == ">" ? "<" : "<=", b, a);
  const Value difference = number(system_.expressions.apply(Operation::subtract, a.node, b.node));
  if (const Precise* known = constant(difference)) {
    result.kind = Value::Kind::truth;
    result.truth = sign == "<"    ? known->is_negative()
                   : sign == "<=" ? known->is_at_most_zero()
                   : sign == "!=" ? !known->is_zero()
                                  : known->is_zero();
    return result;
  }
  using Kind = Relation::Kind;
  if (sign != "==" && sign != "=" && sign != "<" && sign != "<=")
    throw Unreadable(tree.line, sign + " is not understood");
  result.relations = {{sign == "<"    ? Kind::negative
                       : sign == "<=" ? Kind::at_most_zero
                                      : Kind::zero,
                       difference.node}};
  return result;
}

}  // namespace hcsp::verifier
