// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/system.h"

#include <algorithm>
#include <map>

namespace hcsp::verifier {

namespace {

bool takes_two(Operation operation) { return operation >= Operation::add && operation <= Operation::divide; }
bool is_leaf(Operation operation) { return operation <= Operation::unknown; }

Precise image(const Node& node, const Precise& a, const Precise& b) {
  switch (node.operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return power(a, node.exponent);
    case Operation::sqrt:
      return sqrt(a);
    case Operation::exp:
      return exp(a);
    case Operation::log:
      return log(a);
    case Operation::sin:
      return sin(a);
    case Operation::cos:
      return cos(a);
    case Operation::atan:
      return atan(a);
    default:
      return node.value;
  }
}

/// The derivatives by the operands; the second is of no account where there is one operand.
std::pair<Precise, Precise> slopes(const Node& node, const Precise& a, const Precise& b,
                                   const Precise& value) {
  switch (node.operation) {
    case Operation::add:
      return {1.0, 1.0};
    case Operation::subtract:
      return {1.0, -1.0};
    case Operation::multiply:
      return {b, a};
    case Operation::divide:
      return {Precise(1.0) / b, Precise(0.0) - value / b};
    case Operation::power:
      return {Precise(static_cast<double>(node.exponent)) * power(a, node.exponent - 1), 0.0};
    case Operation::sqrt:
      return {Precise(0.5) / value, 0.0};
    case Operation::exp:
      return {value, 0.0};
    case Operation::log:
      return {Precise(1.0) / a, 0.0};
    case Operation::sin:
      return {cos(a), 0.0};
    case Operation::cos:
      return {Precise(0.0) - sin(a), 0.0};
    case Operation::atan:
      return {Precise(1.0) / (power(a, 2) + 1.0), 0.0};
    default:
      return {0.0, 0.0};
  }
}

}  // namespace

std::size_t Expressions::add(Node node) {
  if (!is_leaf(node.operation)) {
    const Node &a = nodes_[node.left], &b = nodes_[node.right];
    if (a.operation == Operation::constant && b.operation == Operation::constant)
      return constant(image(node, a.value, b.value));
  }
  nodes_.push_back(std::move(node));
  return nodes_.size() - 1;
}

std::size_t Expressions::constant(Precise value) {
  return add({Operation::constant, 0, 0, 0, std::move(value)});
}
std::size_t Expressions::unknown(std::size_t number) { return add({Operation::unknown, number, 0, 0, 0.0}); }
std::size_t Expressions::apply(Operation operation, std::size_t left, std::size_t right) {
  return add({operation, left, takes_two(operation) ? right : left, 0, 0.0});
}
std::size_t Expressions::power(std::size_t base, long exponent) {
  return exponent == 0 ? constant(1.0) : add({Operation::power, base, base, exponent, 0.0});
}

std::vector<Precise> System::domains() const {
  std::vector<Precise> all;
  for (const Declaration& each : declarations)
    all.insert(all.end(), each.domains.begin(), each.domains.end());
  return all;
}

std::vector<std::size_t> System::equations() const {
  std::vector<std::size_t> all;
  for (const Relation& relation : relations) {
    if (relation.kind == Relation::Kind::zero) all.push_back(relation.expression);
  }
  return all;
}

Evaluation::Evaluation(const Expressions& expressions, const Place& place) : nodes_(expressions.nodes()) {
  values_.reserve(nodes_.size());
  for (const Node& node : nodes_) {
    if (node.operation == Operation::unknown) {
      values_.push_back(place.at(node.left));
    } else if (node.operation == Operation::constant) {
      values_.push_back(node.value);
    } else {
      values_.push_back(image(node, values_[node.left], values_[node.right]));
    }
  }
}

std::vector<std::size_t> Evaluation::parts_of(std::size_t root) const {
  std::vector<std::size_t> parts, open = {root};
  std::vector<bool> is_seen(nodes_.size(), false);
  is_seen[root] = true;
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    parts.push_back(at);
    if (is_leaf(nodes_[at].operation)) continue;
    for (const std::size_t operand : {nodes_[at].left, nodes_[at].right}) {
      if (!is_seen[operand]) open.push_back(operand);
      is_seen[operand] = true;
    }
  }
  std::sort(parts.rbegin(), parts.rend());  // operands were made before what is made of them
  return parts;
}

Evaluation::Gradient Evaluation::gradient(std::size_t root) const {
  std::map<std::size_t, Precise> adjoints = {{root, 1.0}}, by_unknown;
  for (const std::size_t at : parts_of(root)) {
    const Node& node = nodes_[at];
    const Precise adjoint = adjoints[at];
    if (node.operation == Operation::unknown) {
      Precise& total = by_unknown[node.left];
      total = total + adjoint;
    }
    if (is_leaf(node.operation)) continue;
    const auto [by_left, by_right] = slopes(node, values_[node.left], values_[node.right], values_[at]);
    const auto pass_on = [&](std::size_t operand, const Precise& slope) {
      if (nodes_[operand].operation == Operation::constant) return;
      Precise& total = adjoints[operand];
      total = total + adjoint * slope;
    };
    pass_on(node.left, by_left);
    if (takes_two(node.operation)) pass_on(node.right, by_right);
  }
  return {by_unknown.begin(), by_unknown.end()};
}

}  // namespace hcsp::verifier
