// SPDX-License-Identifier: Apache-2.0
#include "solver/online/code.h"

#include <algorithm>

#include "domains/check.h"
#include "solver/expression/operators.h"
#include "solver/online/schedule.h"

namespace hcsp::online {

namespace {

constexpr Register kOwn = Register{1} << 31;  // until place_after(): an own register

Op op_of(const Instruction& at) { return at.op; }

struct Ranked {
  const Requirement* requirement;
  std::size_t cost;
  Code::Stage stage;
};

std::vector<Ranked> ranked_requirements(Facts& facts, const View& view, Purpose purpose) {
  const std::size_t cheap = purpose == Purpose::search ? 6 : 0;
  std::vector<Ranked> ranked;
  for (const Requirement& own : view.requirements) {
    const std::size_t cost = facts.size(own.root).open;
    ranked.push_back({&own, cost, cost <= cheap ? Code::cheap : own.is_equation() ? Code::main : Code::all});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  return ranked;
}

// Which nodes are quotients by one of these factors, or need one.
std::vector<bool> nodes_of_quotients(const Dag& dag, const std::vector<NodeId>& factors) {
  std::vector<bool> result(dag.size());
  if (factors.empty()) return result;
  for (NodeId id = 0; id < dag.size(); ++id) {  // operands come first
    const DagNode& of = dag[id];
    const int arity = operator_entry(of.op).arity;
    result[id] = of.op == Op::div && std::ranges::count(factors, of.operands[1]) > 0;
    for (int k = 0; k < arity; ++k)
      result[id] = result[id] || result[of.operands[static_cast<std::size_t>(k)]];
  }
  return result;
}

}  // namespace

Prefix::Prefix(const std::vector<Input>& parameters) : size_(static_cast<Register>(parameters.size())) {
  for (Register i = 0; i < parameters.size(); ++i) parameters_.emplace(parameters[i], i);
}

NodeId Prefix::copy(const Dag& from, NodeId node, NodeMap& copies) {
  if (const NodeId* known = copies.find(node)) return *known;
  const DagNode& of = from[node];
  NodeId own{};
  if (of.op == Op::input) {
    own = dag_.input(of.input);
  } else if (of.op == Op::constant) {
    own = copy_constant(of, dag_);
  } else {
    const int arity = operator_entry(of.op).arity;
    std::array<NodeId, 3> operands{};
    for (int k = 0; k < arity; ++k) {
      const auto i = static_cast<std::size_t>(k);
      operands[i] = copy(from, of.operands[i], copies);
    }
    own = dag_.apply(of.op, operands, arity);
  }
  copies.set(node, own);
  return own;
}

Register Prefix::place(const Dag& from, NodeId node, NodeMap& copies) {
  const NodeId own = copy(from, node, copies);
  for (auto id = static_cast<NodeId>(places_.size()); id < dag_.size(); ++id) {
    const DagNode& of = dag_[id];
    if (of.op == Op::input) {
      places_.push_back(parameters_.at(of.input));
      continue;
    }
    const int arity = operator_entry(of.op).arity;
    const auto operand = [&](int k) {
      return places_[of.operands[static_cast<std::size_t>(k < arity ? k : 0)]];
    };
    if (arity == 0)
      constants_.emplace_back(size_, of.value);
    else
      code_.push_back({of.op, static_cast<std::uint8_t>(arity), size_, operand(0), operand(1), operand(2)});
    places_.push_back(size_++);
  }
  return places_[own];
}

Code::Code(Dag& dag, Prefix& prefix, Facts& facts, const View& view, std::size_t objectives, Purpose purpose)
    : core_(view.core.size()), registers_(static_cast<Register>(view.core.size())) {
  require(core_ <= 64, "compile: {} unknowns are left where 64 are allowed", core_);
  for (Register i = 0; i < core_; ++i) {
    places_.set(dag.input(view.core[i]), kOwn | i);
    depends.push_back(std::uint64_t{1} << i);
  }
  const auto test = [&](const Requirement& own, Register reg) {
    return Test{
        reg,     own.wanted, own.strict, own.is_equation(), is_boolean(dag[own.root].op), own.is_implied,
        own.name};
  };
  const std::vector<Ranked> ranked = ranked_requirements(facts, view, purpose);
  for (const Stage stage : {cheap, main, all}) {
    for (const Ranked& own : ranked) {
      if (own.stage != stage) continue;
      tests.push_back(test(*own.requirement, place(dag, prefix, facts, own.requirement->root, values)));
    }
    for (std::size_t i = 0; stage == main && i < objectives; ++i)
      wanted.push_back(place(dag, prefix, facts, view.wanted[i], values));
    end_stage(stage);
  }
  find_real_path();
  const std::vector<bool> of_quotient = nodes_of_quotients(dag, view.nonzero);
  for (const Requirement& own : view.conditions) {
    conditions.push_back(test(own, prefix.place(dag, own.root, givens_)));
    conditions.back().is_of_quotient = of_quotient[own.root];
  }
  for (const NodeId factor : view.nonzero) nonzero.push_back(prefix.place(dag, factor, givens_));
  for (const Bound& bound : view.bounds) {
    const auto v = std::find(view.core.begin(), view.core.end(), bound.variable);
    if (v != view.core.end())
      bounds.push_back({static_cast<std::size_t>(v - view.core.begin()),
                        prefix.place(dag, bound.value, givens_), bound.is_upper});
  }
  const auto of_values = places_;
  add_chain(dag, prefix, facts);
  places_ = of_values;  // slopes are not always computed
  for (const Definition& own : view.definitions)
    definitions.push_back(place(dag, prefix, facts, own.value, rest));
  for (std::size_t i = objectives; i < view.wanted.size(); ++i)
    wanted.push_back(place(dag, prefix, facts, view.wanted[i], further));
  reorder(rest, 0, op_of);
  reorder(further, 0, op_of);
}

Register Code::place(Dag& dag, Prefix& prefix, Facts& facts, NodeId node, std::vector<Instruction>& to) {
  if (const Register* known = places_.find(node); known != nullptr && is_available(*known)) return *known;
  const auto put = [&](Register reg) {
    places_.set(node, reg);
    return reg;
  };
  if (facts.is_given(node)) return put(prefix.place(dag, node, givens_));
  const DagNode of = dag[node];
  const int arity = operator_entry(of.op).arity;
  std::array<Register, 3> operands{};
  std::uint64_t depends_on = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    operands[k] = place(dag, prefix, facts, of.operands[static_cast<int>(k) < arity ? k : 0], to);
    if ((operands[k] & kOwn) != 0) depends_on |= depends[operands[k] & ~kOwn];
  }
  const Register y = kOwn | registers_++;
  depends.push_back(depends_on);
  to.push_back({of.op, static_cast<std::uint8_t>(arity), y, operands[0], operands[1], operands[2]});
  nodes_.push_back(node);
  return put(y);
}

bool Code::is_available(Register reg) const {
  const Register own = reg & ~kOwn;
  return (reg & kOwn) == 0 || own < later_.first || own >= later_.second;
}

// The values of a stage in a good order.
void Code::end_stage(Stage stage) {
  const std::size_t first = stage == cheap ? 0 : ends[stage - 1].values;
  const std::vector<Instruction> before(values.begin() + static_cast<std::ptrdiff_t>(first), values.end());
  const std::vector<NodeId> nodes_before(nodes_.begin() + static_cast<std::ptrdiff_t>(first), nodes_.end());
  std::size_t to = first;
  for (const std::size_t from : schedule(before, op_of)) {
    values[to] = before[from];
    nodes_[to++] = nodes_before[from];
  }
  ends[stage] = {tests.size(), values.size(), 0, 0};
  ends_of_registers_[stage] = registers_;
}

// Derivatives of sums, choices and kinks come directly; the others' slopes from the operators' table.
void Code::add_chain(Dag& dag, Prefix& prefix, Facts& facts) {
  const std::vector<NodeId> nodes = nodes_;
  std::size_t i = 0;
  for (const Stage stage : {cheap, main, all}) {
    const std::size_t first_slope = slopes.size(), first_rule = chain.size();
    // The values of later stages are of another box.
    later_ = {ends_of_registers_[stage], ends_of_registers_[all]};
    for (; i < ends[stage].values; ++i) add_chain_rule(dag, prefix, facts, values[i], nodes[i]);
    reorder(slopes, first_slope, op_of);
    reorder(chain, first_rule, [](const ChainRule& rule) { return rule.kind; });
    ends[stage].slopes = slopes.size();
    ends[stage].chain = chain.size();
  }
  later_ = {};
}

void Code::add_chain_rule(Dag& dag, Prefix& prefix, Facts& facts, const Instruction& at, NodeId node) {
  if (is_boolean(at.op)) return;
  using Kind = ChainRule::Kind;
  const bool has_a = (at.a & kOwn) != 0, has_b = at.arity > 1 && (at.b & kOwn) != 0;
  const auto slope = [&](int k) {
    return place(dag, prefix, facts, operator_entry(at.op).partial(dag, node, k), slopes);
  };
  ChainRule rule{Kind::constant, at.y, at.a, at.b, at.c, at.a, at.b};
  switch (at.op) {
    case Op::neg:
      rule.kind = Kind::negate;
      break;
    case Op::add:
    case Op::sub: {
      const bool is_sum = at.op == Op::add;
      rule.kind = !has_b  ? Kind::copy
                  : has_a ? (is_sum ? Kind::add : Kind::sub)
                          : (is_sum ? Kind::copy : Kind::negate);
      if (!has_a) rule.a = at.b;
      break;
    }
    case Op::min:
    case Op::max:
      rule.kind = at.op == Op::min ? Kind::min : Kind::max;
      rule.is_first_above = at.op == Op::max;
      find_surface(dag, {{dag[node].operands[0], 1}, {dag[node].operands[1], -1}}, rule);
      break;
    case Op::abs:
      rule.kind = Kind::abs;
      rule.is_first_above = true;
      find_surface(dag, {{dag[node].operands[0], 1}}, rule);
      break;
    case Op::if_then_else:
      rule.kind = Kind::choice;
      break;
    case Op::floor:
    case Op::ceil:
    case Op::sign:
      break;
    default:
      rule.kind = has_a && has_b ? Kind::scale_both : at.op == Op::sqrt ? Kind::root : Kind::scale;
      if (has_a) rule.sa = slope(0);
      if (has_b) rule.sb = slope(1);
      if (has_a) break;
      rule.a = at.b;
      rule.sa = rule.sb;
  }
  chain.push_back(rule);
}

// An expression and its negation have one surface: they are told apart as sums of terms.
void Code::find_surface(const Dag& dag, std::initializer_list<std::pair<NodeId, int>> difference,
                        ChainRule& rule) {
  std::map<NodeId, int> terms;
  std::vector<std::pair<NodeId, int>> open = difference;
  while (!open.empty()) {
    const auto [id, sign] = open.back();
    open.pop_back();
    const DagNode& node = dag[id];
    if (node.op == Op::add || node.op == Op::sub) {
      open.emplace_back(node.operands[0], sign);
      open.emplace_back(node.operands[1], node.op == Op::add ? sign : -sign);
    } else if (node.op == Op::neg) {
      open.emplace_back(node.operands[0], -sign);
    } else if (!is_number(dag, id, 0.0) && (terms[id] += sign) == 0) {
      terms.erase(id);
    }
  }
  if (!terms.empty() && terms.begin()->second < 0) {
    for (auto& [id, count] : terms) count = -count;
    rule.is_first_above = !rule.is_first_above;
  }
  const auto [place, is_new] = surface_of_.try_emplace({terms.begin(), terms.end()}, surfaces);
  if (is_new) ++surfaces;
  rule.surface = place->second;
}

// Backward contraction follows the operands of numbers: what a Boolean says of its operands depends on more.
void Code::find_real_path() {
  std::vector<std::uint8_t> is_needed(registers_);
  const auto need = [&](Register reg) {
    if ((reg & kOwn) != 0) is_needed[reg & ~kOwn] = 1;
  };
  std::vector<std::uint8_t> is_truth(registers_);
  for (const Instruction& at : values) is_truth[at.y & ~kOwn] = is_boolean(at.op) ? 1 : 0;
  for (const Test& test : tests) {
    if ((test.reg & kOwn) != 0 && is_truth[test.reg & ~kOwn] == 0) need(test.reg);
  }
  for (const Register objective : wanted) need(objective);
  for (std::size_t i = values.size(); i-- > 0;) {
    const Instruction& at = values[i];
    if (is_needed[at.y & ~kOwn] == 0 || is_boolean(at.op)) continue;
    real_path.push_back(at);
    need(at.a);
    need(at.b);
    need(at.c);
  }
}

void Code::place_after(Register prefix_size) {
  first_ = prefix_size;
  const auto fix = [&](Register& reg) {
    if ((reg & kOwn) != 0) reg = (reg & ~kOwn) + prefix_size;
  };
  for (auto* code : {&values, &slopes, &real_path, &rest, &further}) {
    for (Instruction& at : *code) {
      for (Register* reg : {&at.y, &at.a, &at.b, &at.c}) fix(*reg);
    }
  }
  for (ChainRule& rule : chain) {
    for (Register* reg : {&rule.y, &rule.a, &rule.b, &rule.c, &rule.sa, &rule.sb}) fix(*reg);
  }
  for (Test& test : tests) fix(test.reg);
  for (auto* part : {&definitions, &wanted}) {
    for (Register& reg : *part) fix(reg);
  }
}

}  // namespace hcsp::online
