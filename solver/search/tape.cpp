// SPDX-License-Identifier: Apache-2.0
#include "solver/search/tape.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "domains/check.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

bool is_leaf(Op op) { return op == Op::constant || op == Op::input; }

bool is_total(Op op) {
  return with_operator(op, [](auto known) { return operators::is_total<typename decltype(known)::type>; });
}

// with_operator() of an operator between reals.
template <class F>
bool with_real_operator(Op op, F&& f) {
  return with_operator(op, [&](auto known) {
    if constexpr (!is_boolean(decltype(known)::op)) return f(known);
    HCSP_ASSERT(false);
    return false;
  });
}

}  // namespace

bool fits_tape(const Dag& dag, NodeId root) {
  const std::vector<NodeId> needed = needed_nodes(dag, {root});
  return std::all_of(needed.begin(), needed.end(), [&](NodeId id) {
    const DagNode& node = dag[id];
    if (node.op == Op::input) return node.input.kind == Input::Kind::real;
    const bool is_stepwise = node.op == Op::floor || node.op == Op::ceil || node.op == Op::sign;
    return node.op != Op::if_then_else && !is_boolean(node.op) && !is_stepwise;
  });
}

Tape::Tape(Dag& dag, const std::vector<NodeId>& roots, const std::vector<Input>& variables)
    : variables_(variables.size()), registers_(variables.size()) {
  std::map<NodeId, std::uint32_t> places;
  std::map<Input, std::uint32_t> place_of;
  for (std::uint32_t v = 0; v < variables.size(); ++v) place_of.emplace(variables[v], v);
  const auto place = [&](NodeId id) {
    const DagNode& node = dag[id];
    const std::uint32_t reg =
        node.op == Op::input ? place_of.at(node.input) : static_cast<std::uint32_t>(registers_++);
    places.emplace(id, reg);
    if (node.op == Op::constant) constants_.emplace_back(reg, node.value);
  };
  const auto instruction = [&](NodeId id) {
    const DagNode& node = dag[id];
    const int arity = operator_entry(node.op).arity;
    const auto operand = [&](int k) {
      return places.at(node.operands[static_cast<std::size_t>(k < arity ? k : 0)]);
    };
    return Instruction{node.op,   static_cast<std::uint8_t>(arity), places.at(id), operand(0), operand(1),
                       operand(2)};
  };
  const std::vector<NodeId> needed = needed_nodes(dag, roots);
  for (const NodeId id : needed) {
    if (is_leaf(dag[id].op)) place(id);
  }
  first_result_ = static_cast<std::uint32_t>(registers_);
  for (const NodeId id : needed) {
    if (is_leaf(dag[id].op)) continue;
    place(id);
    code_.push_back(instruction(id));
  }
  // Which nodes depend on a variable at all, and how each depends on its operands.
  std::map<NodeId, bool> varies;
  std::map<NodeId, std::vector<std::pair<NodeId, NodeId>>> chain;  // by node: operand, dy/doperand
  std::vector<NodeId> partials;
  for (const NodeId id : needed) {
    const Op op = dag[id].op;
    varies[id] = op == Op::input;
    for (int k = 0; k < operator_entry(op).arity; ++k) {
      const NodeId operand = dag[id].operands[static_cast<std::size_t>(k)];
      if (!varies.at(operand)) continue;
      varies[id] = true;
      const NodeId slope = operator_entry(op).partial(dag, id, k);
      chain[id].emplace_back(operand, slope);
      partials.push_back(slope);
    }
  }
  for (const NodeId id : needed_nodes(dag, partials)) {
    if (places.contains(id)) continue;
    place(id);
    if (!is_leaf(dag[id].op)) slope_code_.push_back(instruction(id));
  }
  for (const NodeId node : roots) {
    Root& root = roots_.emplace_back();
    root.reg = places.at(node);
    const std::vector<NodeId> own = needed_nodes(dag, {node});
    for (const NodeId id : own) {
      if (dag[id].op == Op::input) root.variables.push_back(places.at(id));
      if (is_leaf(dag[id].op)) continue;
      root.code.push_back(instruction(id));
      if (!is_total(dag[id].op)) root.partial.push_back(root.code.back());
    }
    for (auto id = own.rbegin(); id != own.rend(); ++id) {
      for (const auto& [operand, slope] : chain[*id]) {
        const DagNode& value = dag[slope];
        const bool is_one = value.op == Op::constant && value.value == Interval::raw(1.0, 1.0);
        const bool is_minus_one = value.op == Op::constant && value.value == Interval::raw(-1.0, -1.0);
        root.slopes.push_back({is_one         ? Slope::Kind::one
                               : is_minus_one ? Slope::Kind::minus_one
                                              : Slope::Kind::value,
                               places.at(*id), places.at(operand), places.at(slope)});
      }
    }
  }
}

TapeRun::TapeRun(const Tape& tape)
    : tape_(tape), registers_(tape.registers()), adjoints_(tape.registers()), narrowed_(tape.registers()) {
  for (const auto& [reg, value] : tape_.constants()) registers_[reg] = value;
}

void TapeRun::load(std::span<const Interval> box) { std::copy(box.begin(), box.end(), registers_.begin()); }

void TapeRun::start(std::span<const Interval> box) {
  load(box);
  for (const Tape::Instruction& at : tape_.code()) registers_[at.y] = Interval::entire();
}

template <class Operator>
bool TapeRun::forward_one(const Tape::Instruction& at) {
  const Interval value = Operator::forward(registers_[at.a], registers_[at.b], registers_[at.c]);
  const Interval met = meet(registers_[at.y], value);
  registers_[at.y] = met;
  narrowed_[at.y] = !both(met.bounds() == value.bounds());
  return !met.is_empty();
}

template <class Operator>
bool TapeRun::backward_one(const Tape::Instruction& at) {
  if constexpr (operators::is_total<Operator>) {
    if (narrowed_[at.y] == 0) return true;
  }
  Interval a = registers_[at.a], b = registers_[at.b], c = registers_[at.c];
  Operator::backward(registers_[at.y], a, b, c);
  const auto store = [&](std::uint32_t reg, const Interval& value) {
    const Interval met = meet(registers_[reg], value);
    if (both(met.bounds() == registers_[reg].bounds())) return true;
    if (tape_.is_constant(reg)) return !met.is_empty();
    registers_[reg] = met;
    narrowed_[reg] = 1;
    return !met.is_empty();
  };
  return store(at.a, a) && (at.arity < 2 || store(at.b, b));
}

bool TapeRun::revise(std::size_t i, const Interval& wanted) {
  const std::span<const Tape::Instruction> code = tape_.code(i);
  for (const Tape::Instruction& at : code) {
    const bool alive = with_real_operator(
        at.op, [&](auto known) { return forward_one<typename decltype(known)::type>(at); });
    if (!alive) return false;
  }
  Interval& root = registers_[tape_.root(i)];
  const Interval met = meet(root, wanted);
  if (met.is_empty()) return false;
  if (!(met == root)) narrowed_[tape_.root(i)] = 1;
  root = met;
  for (std::size_t k = code.size(); k-- > 0;) {
    const Tape::Instruction& at = code[k];
    const bool alive = with_real_operator(
        at.op, [&](auto known) { return backward_one<typename decltype(known)::type>(at); });
    if (!alive) return false;
  }
  return true;
}

// Slopes may have choices, and their conditions.
void TapeRun::evaluate_code(std::span<const Tape::Instruction> code) {
  for (const Tape::Instruction& at : code) {
    registers_[at.y] = with_operator(at.op, [&](auto known) {
      return decltype(known)::type::forward(registers_[at.a], registers_[at.b], registers_[at.c]);
    });
  }
}

void TapeRun::evaluate(std::span<const Interval> box, bool with_slopes) {
  load(box);
  evaluate_code(tape_.code());
  if (with_slopes) evaluate_code(tape_.slope_code());
}

void TapeRun::gradient(std::size_t i, std::span<Interval> result) {
  const Interval zero = Interval::raw(0.0, 0.0);
  for (const std::uint32_t v : tape_.variables(i)) adjoints_[v] = zero;
  for (const Tape::Instruction& at : tape_.code(i)) adjoints_[at.y] = zero;
  adjoints_[tape_.root(i)] = Interval::raw(1.0, 1.0);
  for (const Tape::Slope& slope : tape_.slopes(i)) {
    const Interval& y = adjoints_[slope.y];
    Interval& a = adjoints_[slope.a];
    switch (slope.kind) {
      case Tape::Slope::Kind::one:
        a = up::add(a, y);
        break;
      case Tape::Slope::Kind::minus_one:
        a = up::sub(a, y);
        break;
      default:
        a = up::add(a, up::mul(y, registers_[slope.value]));
    }
  }
  for (const std::uint32_t v : tape_.variables(i)) result[v] = adjoints_[v];
}

bool TapeRun::is_continuous(std::size_t i) const {
  const std::span<const Tape::Instruction> partial = tape_.partial(i);
  return std::all_of(partial.begin(), partial.end(), [&](const Tape::Instruction& at) {
    return with_real_operator(at.op, [&](auto known) {
      return operators::is_continuous<typename decltype(known)::type>(registers_[at.a], registers_[at.b]);
    });
  });
}

}  // namespace hcsp
