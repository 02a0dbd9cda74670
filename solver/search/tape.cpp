// SPDX-License-Identifier: Apache-2.0
#include "solver/search/tape.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "domains/check.h"
#include "solver/expression/operators.h"
#include "solver/search/curve.h"

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

Tape::Slope::Kind kind_of(const Dag& dag, NodeId y, NodeId operand, NodeId slope) {
  using Kind = Tape::Slope::Kind;
  const DagNode &node = dag[y], &value = dag[slope];
  if (value.op == Op::constant && value.value == Interval::raw(1.0, 1.0)) return Kind::one;
  if (value.op == Op::constant && value.value == Interval::raw(-1.0, -1.0)) return Kind::minus_one;
  switch (node.op) {
    case Op::sqr:
      return Kind::square;
    case Op::mul:
      return Kind::factor;
    case Op::div:
      return operand == node.operands[1] && operand != node.operands[0] ? Kind::divisor : Kind::derivative;
    default:
      return operator_entry(node.op).arity == 1 || node.op == Op::pown || node.op == Op::root
                 ? Kind::function
                 : Kind::derivative;
  }
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
        const DagNode& y = dag[*id];
        const auto exponent = operator_entry(y.op).arity == 2 ? y.operands[1] : y.operands[0];
        root.slopes.push_back({kind_of(dag, *id, operand, slope), y.op, places.at(*id), places.at(operand),
                               places.at(slope), places.at(exponent)});
      }
    }
  }
}

TapeRun::TapeRun(const Tape& tape)
    : tape_(tape),
      registers_(tape.registers()),
      center_(tape.registers()),
      adjoints_(tape.registers()),
      narrowed_(tape.registers()) {
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

// From the root down to the variables.
template <class SlopeOf>
void TapeRun::accumulate(std::size_t i, std::span<Interval> result, SlopeOf slope_of) {
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
        a = up::add(a, up::mul(y, slope_of(slope)));
    }
  }
  for (const std::uint32_t v : tape_.variables(i)) result[v] = adjoints_[v];
}

void TapeRun::gradient(std::size_t i, std::span<Interval> result) {
  accumulate(i, result, [&](const Tape::Slope& slope) { return registers_[slope.value]; });
}

void TapeRun::evaluate_from(std::span<const Interval> center, std::span<const Interval> box) {
  evaluate(center, false);
  std::copy(registers_.begin(), registers_.end(), center_.begin());
  evaluate(box, true);
}

void TapeRun::slopes(std::size_t i, std::span<Interval> result) {
  accumulate(i, result, [&](const Tape::Slope& slope) { return slope_from_center(slope); });
}

// With a', b', y' the values at the centre: aa - a'a' = (a + a')(a - a'); ab - a'b' is the mean of b and b'
// times a - a' and that of a and a' times b - b'; y/a - y'/a' = (y - y')/a - (y'/a')/a (a - a').
Interval TapeRun::slope_from_center(const Tape::Slope& slope) const {
  switch (slope.kind) {
    case Tape::Slope::Kind::square:
      return up::add(registers_[slope.a], center_[slope.a]);
    case Tape::Slope::Kind::factor:
      return up::mul(Interval::raw(0.5, 0.5), up::add(registers_[slope.value], center_[slope.value]));
    case Tape::Slope::Kind::divisor:
      return -up::div(center_[slope.y], registers_[slope.a]);
    case Tape::Slope::Kind::function:
      return slope_of_function(slope);
    default:
      return registers_[slope.value];
  }
}

// The slope of the chord from the centre rises with its other end where the function is convex, and falls
// where it is concave.
Interval TapeRun::slope_of_function(const Tape::Slope& slope) const {
  const Interval &a = registers_[slope.a], &derivative = registers_[slope.value];
  const Curve curve{slope.op, registers_[slope.exponent]};
  const Interval bend = curve.bend(a);
  const bool is_convex = bend.lo() >= 0.0;
  if (!is_convex && !(bend.hi() <= 0.0)) return derivative;
  const auto chord_to = [&](double end) {
    const Interval point = Interval::raw(end, end);
    return up::div(up::sub(curve.value(point), center_[slope.y]), up::sub(point, center_[slope.a]));
  };
  const Interval at_lo = chord_to(a.lo()), at_hi = chord_to(a.hi());
  if (at_lo.is_empty() || at_hi.is_empty()) return derivative;
  const Interval chords =
      is_convex ? Interval::raw(at_lo.lo(), at_hi.hi()) : Interval::raw(at_hi.lo(), at_lo.hi());
  return meet(chords, derivative);
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
