// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/program.h"

#include <algorithm>
#include <map>
#include <type_traits>
#include <unordered_map>

#include "domains/check.h"
#include "solver/expression/operators.h"

namespace hcsp {

Program::Program(const Dag& dag, const std::vector<NodeId>& roots) {
  const std::vector<NodeId> needed = needed_nodes(dag, roots);
  const auto assign = [&](NodeId id) { places_[id] = static_cast<std::uint32_t>(registers_++); };
  for (const NodeId id : needed) {
    if (dag[id].op != Op::input) continue;
    inputs_.push_back(dag[id].input);
    assign(id);
  }
  for (const NodeId id : needed) {
    if (dag[id].op != Op::constant) continue;
    constants_.push_back(dag[id].value);
    assign(id);
  }
  std::unordered_map<NodeId, unsigned> axes;  // of the bound point
  for (const NodeId id : needed) {
    const DagNode& node = dag[id];
    unsigned& own = axes[id];
    if (node.op == Op::input && node.input.kind == Input::Kind::point) own = 1U << node.input.component;
    for (int k = 0; k < operator_entry(node.op).arity; ++k)
      own |= axes.at(node.operands[static_cast<std::size_t>(k)]);
  }
  for (const bool with_point : {false, true}) {
    for (const NodeId id : needed) {
      const DagNode& node = dag[id];
      const int arity = operator_entry(node.op).arity;
      if (arity == 0 || (axes.at(id) != 0) != with_point) continue;
      assign(id);
      const auto operand = [&](int k) {
        return places_.at(node.operands[static_cast<std::size_t>(k < arity ? k : 0)]);
      };
      code_.push_back({node.op, places_.at(id), operand(0), operand(1), operand(2), arity});
    }
    if (!with_point) point_code_ = code_.size();
  }
  for (const NodeId root : roots) roots_.push_back(places_.at(root));
  axes_.resize(registers_);
  for (const auto& [id, reg] : places_) axes_[reg] = axes.at(id);
}

namespace {

constexpr std::uint64_t kEveryLane = ~std::uint64_t{0};

/// Boxes side by side from which on a batch form is faster than one after the other.
constexpr std::size_t kBatch = 8;

constexpr std::uint64_t first_lanes(std::size_t lanes) {
  return lanes == 64 ? kEveryLane : (std::uint64_t{1} << lanes) - 1;
}

}  // namespace

Evaluation::Evaluation(const Program& program, std::size_t row, const std::vector<Place>& layout)
    : program_(&program),
      row_(row),
      places_(layout),
      defined_(program.registers(), kEveryLane),
      needed_(program.registers()),
      narrowed_(program.registers()) {
  std::uint32_t size = 0;
  for (Place& at : places_) {
    at.offset = size;
    size += at.mask + 1U;
  }
  registers_.resize(size);
  for (std::size_t k = 0; k < program.constants().size(); ++k)
    set(static_cast<std::uint32_t>(program.inputs().size() + k), program.constants()[k]);
}

Evaluation::Evaluation(const Program& program, std::size_t lanes)
    : Evaluation(program, kMaxLanes, [&] {
        HCSP_ASSERT(lanes > 0 && lanes <= kMaxLanes);
        std::uint8_t mask = 0;
        while (mask + 1U < lanes) mask = static_cast<std::uint8_t>(2 * mask + 1);
        std::vector<Place> layout(program.registers());
        for (std::uint32_t reg = 0; reg < layout.size(); ++reg)
          layout[reg].mask = program.is_constant(reg) ? 0 : mask;
        return layout;
      }()) {}

Evaluation Evaluation::over_children(const Program& program, std::size_t dim) {
  const unsigned axis_bits = 6 / static_cast<unsigned>(dim);
  std::vector<Place> layout(program.registers());
  for (std::uint32_t reg = 0; reg < layout.size(); ++reg) {
    const unsigned axes = program.axes(reg);
    if (axes == 0) continue;
    const bool single = (axes & (axes - 1)) == 0;
    layout[reg].shift =
        static_cast<std::uint8_t>(single ? axis_bits * static_cast<unsigned>(__builtin_ctz(axes)) : 0U);
    layout[reg].mask = static_cast<std::uint8_t>(single ? (1U << axis_bits) - 1U : 63U);
  }
  return {program, std::size_t{1} << axis_bits, layout};
}

void Evaluation::save(Prefix& prefix, std::size_t lane) const {
  prefix.registers.clear();
  prefix.defined.clear();
  for (std::uint32_t reg = 0; reg < places_.size(); ++reg) {
    if (program_->axes(reg) != 0) continue;
    prefix.registers.push_back(get(reg, lane));
    prefix.defined.push_back(defined(reg, lane) ? kEveryLane : 0);
  }
}

void Evaluation::restore(const Prefix& prefix) {
  std::size_t saved = 0;
  for (std::uint32_t reg = 0; reg < places_.size(); ++reg) {
    if (program_->axes(reg) != 0) continue;
    registers_[places_[reg].offset] = prefix.registers[saved];
    defined_[reg] = prefix.defined[saved++];
  }
}

// Row by row of values that stand side by side; in a row an operand moves on with its lanes or stays.
template <class Operator, bool kBoolean, bool kRelation, bool kCore>
void Evaluation::forward_one(const Program::Instruction& at, std::size_t lanes) {
  const Place &of_y = places_[at.result], &of_a = places_[at.a], &of_b = places_[at.b], &of_c = places_[at.c];
  const std::uint64_t operands_defined = defined_[at.a] & defined_[at.b] & defined_[at.c];
  constexpr bool kChoice = std::is_same_v<Operator, operators::IfThenElse>;
  constexpr bool kPartial = !kBoolean && !kChoice && !operators::is_total<Operator>;
  std::uint64_t defined_values = 0;  // a bit a value
  const std::size_t values = std::min<std::size_t>(lanes, of_y.mask + 1U);
  const std::size_t row = std::min(values, row_);
  for (std::size_t first = 0; first < values; first += row) {
    if (values == kMaxLanes && (wanted_ >> first & first_lanes(row)) == 0) continue;
    Interval* y = &registers_[of_y.offset + first];
    const auto start = [&](const Place& of) { return &registers_[place(of, first << of_y.shift)]; };
    const auto step = [&](const Place& of) { return of.shift == of_y.shift ? of.mask & 1U : 0U; };
    const Interval *a = start(of_a), *b = start(of_b), *c = start(of_c);
    const std::size_t step_a = step(of_a), step_b = step(of_b), step_c = step(of_c);
    if constexpr (!kCore && requires { Operator::row(row, a, b, y); }) {
      if (row >= kBatch && step_a == 1 && step_b == 1) {
        Operator::row(row, a, b, y);
        for (std::size_t i = 0; kPartial && i < row; ++i)
          defined_values |= static_cast<std::uint64_t>(Operator::defined(a[i], b[i], c[i])) << (first + i);
        continue;
      }
    }
    for (std::size_t i = 0; i < row; ++i, ++y, a += step_a, b += step_b, c += step_c) {
      Interval value;
      if constexpr (kCore) {
        value = operators::core<Operator>(*a, *b, *c);
      } else {
        value = Operator::forward(*a, *b, *c);
      }
      if constexpr (kRelation && !kCore) {
        // False where a term is undefined: not certain unless both are defined on the whole box.
        const std::size_t lane = (first + i) << of_y.shift;
        if (up::is_any_empty(*a, *b)) {
          value = kFalse;
        } else if (((operands_defined >> lane) & 1U) == 0) {
          value = join(value, kFalse);
        }
      }
      if constexpr (kPartial)
        defined_values |= static_cast<std::uint64_t>(Operator::defined(*a, *b, *c)) << (first + i);
      if constexpr (kChoice) {
        const std::size_t lane = (first + i) << of_y.shift;
        const bool is_defined = (operators::is_false(*a) || this->defined(at.b, lane)) &&
                                (operators::is_true(*a) || this->defined(at.c, lane));
        defined_values |= static_cast<std::uint64_t>(is_defined) << (first + i);
      }
      *y = value;
    }
  }
  if constexpr (kBoolean) {
    defined_[at.result] = kEveryLane;
  } else if constexpr (kChoice) {
    defined_[at.result] = by_lane(of_y, defined_values, lanes);
  } else if constexpr (kPartial) {
    defined_[at.result] = operands_defined & by_lane(of_y, defined_values, lanes);
  } else {
    defined_[at.result] = operands_defined;
  }
}

// A bit a lane of what has a bit a value.
std::uint64_t Evaluation::by_lane(const Place& at, std::uint64_t values, std::size_t lanes) {
  if (at.mask == 0) return (values & 1U) != 0 ? kEveryLane : 0;
  if (at.shift == 0 && at.mask + 1U >= lanes) return values;
  std::uint64_t found = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    found |= (values >> (place(at, lane) - at.offset) & 1U) << lane;
  return found;
}

template <bool kCore>
void Evaluation::run_forward(std::size_t first, std::size_t last, std::size_t lanes) {
  HCSP_ASSERT(lanes <= kMaxLanes);
  for (const Program::Instruction& at : program_->code().subspan(first, last - first)) {
    with_operator(at.op, [&](auto known) {
      using Known = decltype(known);
      forward_one<typename Known::type, is_boolean(Known::op), is_relation(Known::op), kCore>(at, lanes);
    });
  }
}

template void Evaluation::run_forward<false>(std::size_t, std::size_t, std::size_t);
template void Evaluation::run_forward<true>(std::size_t, std::size_t, std::size_t);

// A register's operands are contracted only where the root needs its value: below an undecided branch nothing
// is known.
template <class Operator, bool kBoolean, bool kRelation>
bool Evaluation::backward_one(const Program::Instruction& at) {
  std::uint64_t open = needed_[at.result];
  if constexpr (operators::is_total<Operator> && !kBoolean) {
    // Where a total operation's result is as forward gave it, any value of one operand goes with some of the
    // others: nothing can be learnt of them.
    const std::uint64_t idle = open & ~narrowed_[at.result];
    needed_[at.a] |= idle;
    needed_[at.b] |= idle;
    needed_[at.c] |= idle;
    open &= narrowed_[at.result];
  }
  for (; open != 0; open &= open - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctzll(open));
    const Interval y = get(at.result, lane);
    Interval a = get(at.a, lane), b = get(at.b, lane), c = get(at.c, lane);
    bool need_a = true, need_b = true, need_c = true;
    if constexpr (kRelation) {
      const bool defined = ((defined_[at.a] & defined_[at.b]) >> lane & 1U) != 0;
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
      const Interval known = get(reg, lane), met = meet(known, value);
      if (!(met == known) && !program_->is_constant(reg)) {
        set(reg, met, lane);
        narrowed_[reg] |= std::uint64_t{1} << lane;
      }
      if (need) needed_[reg] |= std::uint64_t{1} << lane;
      return !(met.is_empty() && (need || kBoolean));
    };
    if (!store(at.a, a, need_a) || (at.arity > 1 && !store(at.b, b, need_b)) ||
        (at.arity > 2 && !store(at.c, c, need_c))) {
      failed_lane_ = lane;
      return false;
    }
  }
  return true;
}

bool Evaluation::backward(const Interval& wanted, std::size_t i, std::size_t lanes) {
  HCSP_ASSERT(lanes <= kMaxLanes);
  std::fill(needed_.begin(), needed_.end(), std::uint64_t{0});
  std::fill(narrowed_.begin(), narrowed_.end(), std::uint64_t{0});
  const std::uint32_t root = program_->root(i);
  needed_[root] = first_lanes(lanes);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Interval known = get(root, lane), met = meet(known, wanted);
    if (met.is_empty()) return failed_lane_ = lane, false;
    if (met == known) continue;
    set(root, met, lane);
    narrowed_[root] |= std::uint64_t{1} << lane;
  }
  const auto code = program_->code();
  for (std::size_t k = code.size(); k-- > 0;) {
    const Program::Instruction& at = code[k];
    const bool alive = with_operator(at.op, [&](auto known) {
      using Known = decltype(known);
      return backward_one<typename Known::type, is_boolean(Known::op), is_relation(Known::op)>(at);
    });
    if (!alive) return false;
  }
  return true;
}

}  // namespace hcsp
