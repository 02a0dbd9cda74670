// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/program.h"

#include <algorithm>
#include <map>

#include "domains/check.h"
#include "solver/expression/operators.h"

namespace hcsp {

Program::Program(const Dag& dag, const std::vector<NodeId>& roots) {
  // The nodes that the roots need; an index order is an evaluation order.
  std::vector<bool> needed(dag.size(), false);
  for (const NodeId root : roots) needed[root] = true;
  for (std::size_t id = dag.size(); id-- > 0;) {
    const DagNode& node = dag[static_cast<NodeId>(id)];
    const int arity = operator_entry(node.op).arity;
    for (int k = 0; needed[id] && k < arity; ++k) needed[node.operands[static_cast<std::size_t>(k)]] = true;
  }
  const auto assign = [&](NodeId id) { places_[id] = static_cast<std::uint32_t>(registers_++); };
  for (NodeId id = 0; id < dag.size(); ++id) {
    if (!needed[id] || dag[id].op != Op::input) continue;
    inputs_.push_back(dag[id].input);
    assign(id);
  }
  for (NodeId id = 0; id < dag.size(); ++id) {
    if (!needed[id] || dag[id].op != Op::constant) continue;
    constants_.push_back(dag[id].value);
    assign(id);
  }
  std::vector<bool> on_point(dag.size(), false);
  for (NodeId id = 0; id < dag.size(); ++id) {
    const DagNode& node = dag[id];
    on_point[id] = node.op == Op::input && node.input.kind == Input::Kind::point;
    for (int k = 0; k < operator_entry(node.op).arity; ++k) {
      on_point[id] = on_point[id] || on_point[node.operands[static_cast<std::size_t>(k)]];
    }
  }
  for (const bool with_point : {false, true}) {
    for (NodeId id = 0; id < dag.size(); ++id) {
      const DagNode& node = dag[id];
      const int arity = operator_entry(node.op).arity;
      if (!needed[id] || arity == 0 || on_point[id] != with_point) continue;
      assign(id);
      const auto operand = [&](int k) {
        return places_.at(node.operands[static_cast<std::size_t>(k < arity ? k : 0)]);
      };
      code_.push_back({node.op, places_.at(id), operand(0), operand(1), operand(2)});
    }
    if (!with_point) point_code_ = code_.size();
  }
  for (const NodeId root : roots) roots_.push_back(places_.at(root));
  std::vector<bool> used(registers_, false);
  for (const Instruction& at : code_) {
    const std::array<std::uint32_t, 3> operands{at.a, at.b, at.c};
    for (int k = 0; k < operator_entry(at.op).arity; ++k) {
      const std::uint32_t operand = operands[static_cast<std::size_t>(k)];
      if (used[operand] && !is_constant(operand)) single_use_ = false;
      used[operand] = true;
    }
  }
}

Evaluation::Evaluation(const Program& program, std::size_t lanes)
    : program_(&program),
      lanes_(lanes),
      lo_(program.registers() * lanes, -kInfinity),
      hi_(program.registers() * lanes, kInfinity),
      defined_(program.registers() * lanes, 1),
      needed_(program.registers() * lanes, 0) {
  HCSP_ASSERT(lanes > 0);
  for (std::size_t k = 0; k < program.constants().size(); ++k) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      set(static_cast<std::uint32_t>(program.inputs().size() + k), program.constants()[k], lane);
    }
  }
}

template <class Operator, bool kBoolean, bool kRelation>
void Evaluation::forward_one(const Program::Instruction& at, std::size_t lanes) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Interval a = get(at.a, lane), b = get(at.b, lane), c = get(at.c, lane);
    Interval y = Operator::forward(a, b, c);
    bool defined = defined_[at.a * lanes_ + lane] != 0 && defined_[at.b * lanes_ + lane] != 0 &&
                   defined_[at.c * lanes_ + lane] != 0 && Operator::defined(a, b, c);
    if constexpr (kRelation) {
      // False where a term is undefined: not certain unless both are defined on the whole box.
      if (a.is_empty() || b.is_empty()) {
        y = kFalse;
      } else if (!defined) {
        y = join(y, kFalse);
      }
    }
    if constexpr (std::is_same_v<Operator, operators::IfThenElse>) {
      const bool then_defined = defined_[at.b * lanes_ + lane] != 0,
                 else_defined = defined_[at.c * lanes_ + lane] != 0;
      defined = (then_defined || operators::is_false(a)) && (else_defined || operators::is_true(a));
    }
    set(at.result, y, lane);
    defined_[at.result * lanes_ + lane] = kBoolean || defined ? 1 : 0;
  }
}

void Evaluation::run_forward(std::size_t first, std::size_t last, std::size_t lanes) {
  HCSP_ASSERT(lanes <= lanes_);
  for (const Program::Instruction& at : program_->code().subspan(first, last - first)) {
    switch (at.op) {
#define HCSP_FORWARD(name, type, text, arity)                                             \
  case Op::name:                                                                          \
    forward_one<operators::type, is_boolean(Op::name), is_relation(Op::name)>(at, lanes); \
    break;
      HCSP_OPERATORS(HCSP_FORWARD)
#undef HCSP_FORWARD
      default:
        HCSP_ASSERT(false);
    }
  }
}

// A register's operands are contracted only where the root needs its value: below an undecided branch nothing
// is known.
template <class Operator, bool kBoolean, bool kRelation>
bool Evaluation::backward_one(const Program::Instruction& at, std::size_t lanes) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t y_place = at.result * lanes_ + lane;
    if (needed_[y_place] == 0) continue;
    const Interval y = get(at.result, lane);
    Interval a = get(at.a, lane), b = get(at.b, lane), c = get(at.c, lane);
    bool need_a = true, need_b = true, need_c = true;
    if constexpr (kRelation) {
      const bool defined = defined_[at.a * lanes_ + lane] != 0 && defined_[at.b * lanes_ + lane] != 0;
      if (!operators::is_true(y) && !(operators::is_false(y) && defined)) continue;
    }
    Operator::backward(y, a, b, c);
    if constexpr (kBoolean && !kRelation) {
      need_a = a.is_point();
      need_b = b.is_point();
    }
    if constexpr (std::is_same_v<Operator, operators::IfThenElse>) {
      need_a = a.is_point();
      need_b = operators::is_true(a);
      need_c = operators::is_false(a);
      if (a.is_empty()) return failed_lane_ = lane, false;
    }
    const auto store = [&](std::uint32_t reg, const Interval& value, bool need) {
      const Interval met = meet(get(reg, lane), value);
      if (!program_->is_constant(reg)) set(reg, met, lane);
      if (need) needed_[reg * lanes_ + lane] = 1;
      return !(met.is_empty() && (need || kBoolean));
    };
    if (!store(at.a, a, need_a) || !store(at.b, b, need_b) || !store(at.c, c, need_c)) {
      failed_lane_ = lane;
      return false;
    }
  }
  return true;
}

bool Evaluation::backward(const Interval& wanted, std::size_t i, std::size_t lanes) {
  HCSP_ASSERT(lanes <= lanes_);
  std::fill(needed_.begin(), needed_.end(), std::uint8_t{0});
  const std::uint32_t root = program_->root(i);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Interval met = meet(get(root, lane), wanted);
    if (met.is_empty()) return failed_lane_ = lane, false;
    set(root, met, lane);
    needed_[root * lanes_ + lane] = 1;
  }
  const auto code = program_->code();
  for (std::size_t k = code.size(); k-- > 0;) {
    const Program::Instruction& at = code[k];
    bool alive = true;
    switch (at.op) {
#define HCSP_BACKWARD(name, type, text, arity)                                                     \
  case Op::name:                                                                                   \
    alive = backward_one<operators::type, is_boolean(Op::name), is_relation(Op::name)>(at, lanes); \
    break;
      HCSP_OPERATORS(HCSP_BACKWARD)
#undef HCSP_BACKWARD
      default:
        HCSP_ASSERT(false);
    }
    if (!alive) return false;
  }
  return true;
}

bool Evaluation::revise(const Interval& wanted) {
  HCSP_ASSERT(lanes_ == 1);
  const auto inputs = static_cast<std::ptrdiff_t>(program_->inputs().size());
  const int rounds = program_->single_use() ? 1 : kRounds;
  for (int round = 0; round < rounds; ++round) {
    lo_before_.assign(lo_.begin(), lo_.begin() + inputs);
    hi_before_.assign(hi_.begin(), hi_.begin() + inputs);
    forward();
    if (!backward(wanted)) return false;
    if (std::equal(lo_before_.begin(), lo_before_.end(), lo_.begin()) &&
        std::equal(hi_before_.begin(), hi_before_.end(), hi_.begin())) {
      break;
    }
  }
  return true;
}

}  // namespace hcsp
