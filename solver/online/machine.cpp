// SPDX-License-Identifier: Apache-2.0
#include "solver/online/machine.h"

#include <algorithm>

#include "solver/expression/operators.h"
#include "solver/online/truth.h"

namespace hcsp::online {

namespace {

constexpr bool is_step(Op op) { return op == Op::floor || op == Op::ceil || op == Op::sign; }

}  // namespace

Machine::Machine(const Prefix& prefix, std::size_t own_registers, std::size_t core, std::size_t surfaces)
    : first_(prefix.size()),
      values_(prefix.size() + own_registers),
      slopes_((own_registers + 1) * core),
      kept_(own_registers),
      flags_(values_.size(), kDefined | kLipschitz),
      needed_(values_.size()),
      reals_(values_.size()),
      real_slopes_((own_registers + 1) * lanes(core)),
      sides_(surfaces, Side::both) {
  for (const auto& [reg, value] : prefix.constants()) values_[reg] = value;
}

void Machine::load(std::span<const Interval> parameters) {
  std::copy(parameters.begin(), parameters.end(), values_.begin());
}

void Machine::load_real(const Code& code) {
  for (const Register reg : code.reads) reals_[reg] = 0.5 * values_[reg].lo() + 0.5 * values_[reg].hi();
}

// Of the branch that is taken; of both, and with a jump, where that is open.
std::uint8_t Machine::flags_of_choice(const Instruction& at, const Interval* values,
                                      const std::uint8_t* flags) {
  if (operators::is_true(values[at.a])) return flags[at.b];
  if (operators::is_false(values[at.a])) return flags[at.c];
  return static_cast<std::uint8_t>(flags[at.b] & flags[at.c] & kDefined);
}

template <Op kOp, class Operator>
void Machine::run_one(const Instruction& at, Interval* values, std::uint8_t* all_flags, std::uint8_t known) {
  const Interval &a = values[at.a], &b = values[at.b], &c = values[at.c];
  const Interval y = Operator::forward(a, b, c);
  auto flags = static_cast<std::uint8_t>(all_flags[at.a] & all_flags[at.b]);
  if constexpr (is_relation(kOp)) {
    values[at.y] = truth(y, a, b, (flags & kDefined) != 0);
    all_flags[at.y] = kDefined;
    return;
  } else if constexpr (is_boolean(kOp)) {
    flags = kDefined;
  } else if constexpr (kOp == Op::if_then_else) {
    flags = flags_of_choice(at, values, all_flags);
  } else if constexpr (is_step(kOp)) {
    if (!y.is_point()) flags &= kDefined;
  } else if constexpr (kOp == Op::sqrt) {
    // Where it is not defined the slopes are those of sqrt(max(a, 0)).
    if (!(a.lo() >= 0.0)) flags &= kLipschitz;
  } else if constexpr (!operators::is_total<Operator>) {
    if (!Operator::defined(a, b, c)) flags = 0;
    if (!operators::is_continuous<Operator>(a, b)) flags &= kDefined;
  }
  values[at.y] = y;
  all_flags[at.y] = static_cast<std::uint8_t>(flags | known);
}

// One dispatch for a run of instructions of one operator. `known`: flags that all have. As a template of two
// instances its operators would no longer be inlined, and all would take a third longer.
void Machine::run(std::span<const Instruction> code, std::uint8_t known) {
  Interval* const values = values_.data();
  std::uint8_t* const flags = flags_.data();
  for (const Instruction *at = code.data(), *end = at + code.size(); at != end;) {
    with_operator(at->op, [&](auto own) {
      const Instruction* next = at;
      do {
        run_one<decltype(own)::op, typename decltype(own)::type>(*next++, values, flags, known);
      } while (next != end && next->op == decltype(own)::op);
      at = next;
    });
  }
}

// What depends on no unknown is Lipschitz in them, whichever alternative is taken.
void Machine::evaluate(std::span<const Instruction> givens) { run(givens, kLipschitz); }

void Machine::evaluate(std::span<const Section> givens) {
  const auto may_be = [&](const Guard& guard) {
    const Interval& boolean = values_[guard.boolean];
    return guard.wanted ? !operators::is_false(boolean) : !operators::is_true(boolean);
  };
  for (const Section& section : givens) {
    if (std::ranges::all_of(section.guards, may_be)) evaluate(std::span<const Instruction>(section.code));
  }
}

void Machine::load(const Code& code, std::span<const Interval> box) {
  std::copy(box.begin(), box.end(), values_.begin() + code.first());
  std::fill_n(flags_.begin() + code.first(), box.size(), kDefined | kLipschitz);
}

void Machine::evaluate(const Code& code, std::span<const Interval> box, Code::Stage last) {
  load(code, box);
  run(std::span(code.values).first(code.ends[last].values));
}

void Machine::keep(const Code& code) {
  std::copy_n(values_.begin() + code.first(), code.registers(), kept_.begin());
}
void Machine::recall(const Code& code) {
  std::copy_n(kept_.begin(), code.registers(), values_.begin() + code.first());
}

bool Machine::evaluate_while_possible(const Code& code, std::span<const Interval> box, Code::Stage last) {
  load(code, box);
  const std::span<const Instruction> values = code.values;
  Code::End done{};
  for (std::size_t stage = Code::cheap; stage <= last; ++stage) {
    const Code::End& end = code.ends[stage];
    run(values.subspan(done.values, end.values - done.values));
    for (std::size_t i = done.tests; i < end.tests; ++i) {
      if (is_possible(code.tests[i])) continue;
      refuted_by_ = code.tests[i].name;
      return false;
    }
    done = end;
  }
  return true;
}

template <ChainRule::Kind kKind>
void Machine::apply(const ChainRule& rule) {
  using Kind = ChainRule::Kind;
  const Interval *a = slopes_of(rule.a), *b = slopes_of(rule.b), *c = slopes_of(rule.c);
  const Interval &va = values_[rule.a], &vb = values_[rule.b];
  Interval* const y = &slopes_[(rule.y - first_ + 1) * columns_];
  const auto set = [&](auto value_of) {
    for (std::size_t k = 0; k < columns_; ++k) y[k] = value_of(k);
  };
  // a', or what is beyond the kink, or both.
  const auto at_kink = [&](bool is_first, bool is_second, auto second) {
    const Side side = is_first || is_second ? Side::both : sides_[rule.surface];
    const bool is_chosen = side != Side::both, is_above = side == Side::above;
    if (is_first || (is_chosen && is_above == rule.is_first_above))
      return set([&](std::size_t k) { return a[k]; });
    if (is_second || is_chosen) return set(second);
    set([&](std::size_t k) { return join(a[k], second(k)); });
  };
  const auto one_of = [&](bool is_first, bool is_second, const Interval* first, const Interval* second) {
    if (is_first) return set([&](std::size_t k) { return first[k]; });
    if (is_second) return set([&](std::size_t k) { return second[k]; });
    set([&](std::size_t k) { return join(first[k], second[k]); });
  };
  // Of a slope that has no value anywhere, as that of root(a, 3) at a = 0, nothing is known.
  const auto slope_in = [&](Register reg) {
    return values_[reg].is_empty() ? Interval::entire() : values_[reg];
  };
  // Of what does not depend on an unknown there is nothing to multiply.
  const auto product = [](const Interval& slope, const Interval& of) {
    return both(of.bounds() == 0.0) ? of : up::mul(slope, of);
  };
  switch (kKind) {
    case Kind::copy:
      return set([&](std::size_t k) { return a[k]; });
    case Kind::negate:
      return set([&](std::size_t k) { return -a[k]; });
    case Kind::add:
      return set([&](std::size_t k) { return up::add(a[k], b[k]); });
    case Kind::sub:
      return set([&](std::size_t k) { return up::sub(a[k], b[k]); });
    case Kind::min:
      return at_kink(va.hi() <= vb.lo(), vb.hi() <= va.lo(), [&](std::size_t k) { return b[k]; });
    case Kind::max:
      return at_kink(va.lo() >= vb.hi(), vb.lo() >= va.hi(), [&](std::size_t k) { return b[k]; });
    case Kind::choice:
      return one_of(operators::is_true(va), operators::is_false(va), b, c);
    case Kind::abs:
      return at_kink(va.lo() >= 0.0, va.hi() <= 0.0, [&](std::size_t k) { return -a[k]; });
    case Kind::constant:
      return set([](std::size_t) { return Interval::raw(0.0, 0.0); });
    case Kind::root: {
      const bool is_known = va.lo() >= 0.0 && va.hi() > 0.0;
      const Interval slope = is_known ? values_[rule.sa] : Interval::raw(0.0, kInfinity);
      return set([&](std::size_t k) { return product(slope, a[k]); });
    }
    case Kind::scale: {
      const Interval slope = slope_in(rule.sa);
      return set([&](std::size_t k) { return product(slope, a[k]); });
    }
    case Kind::scale_both: {
      const Interval by_a = slope_in(rule.sa), by_b = slope_in(rule.sb);
      return set([&](std::size_t k) { return up::add(product(by_a, a[k]), product(by_b, b[k])); });
    }
  }
}

bool Machine::find_open_surfaces(const Code& code, Code::Stage last, std::span<std::uint32_t> found,
                                 std::size_t& count) const {
  count = 0;
  for (const ChainRule& rule : std::span(code.chain).first(code.ends[last].chain)) {
    using Kind = ChainRule::Kind;
    const bool is_kink = rule.kind == Kind::min || rule.kind == Kind::max;
    if (!is_kink && rule.kind != Kind::abs) continue;
    const Interval &a = values_[rule.a], &b = values_[rule.b];
    const bool is_open = is_kink ? a.hi() > b.lo() && b.hi() > a.lo() : a.lo() < 0.0 && a.hi() > 0.0;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(count);
    if (!is_open || std::find(found.begin(), end, rule.surface) != end) continue;
    if (count == found.size()) return false;
    found[count++] = rule.surface;
  }
  return true;
}

void Machine::differentiate(const Code& code, std::uint64_t active, Code::Stage last) {
  run(std::span(code.slopes).first(code.ends[last].slopes));
  columns_ = static_cast<std::size_t>(__builtin_popcountll(active));
  std::fill_n(slopes_.begin(), (code.core() + 1) * columns_, Interval::raw(0.0, 0.0));
  std::size_t k = 0;
  for (std::uint64_t left = active; left != 0; left &= left - 1, ++k) {
    const auto v = static_cast<std::size_t>(__builtin_ctzll(left));
    slopes_[(v + 1) * columns_ + k] = Interval::raw(1.0, 1.0);
  }
  for_each_rule(std::span(code.chain).first(code.ends[last].chain),
                [&](auto kind, const ChainRule& rule) { apply<kind()>(rule); });
}

bool Machine::narrow(const Code& code, Register reg, const Interval& value) {
  const Interval met = meet(values_[reg], value);
  if (reg >= code.first()) {
    needed_[reg] = std::max(needed_[reg], met == values_[reg] ? Need::value : Need::narrower);
    values_[reg] = met;
  }
  return !met.is_empty();
}

// What is as wide as it was computed tells nothing of its operands but that they are where it has a value.
template <Op kOp, class Operator>
bool Machine::revise_one(const Code& code, const Instruction& at) {
  if constexpr (kOp == Op::if_then_else) {
    // Only what is taken has to be defined, and to give the value.
    const bool is_then = operators::is_true(values_[at.a]);
    if (!is_then && !operators::is_false(values_[at.a])) return true;
    return narrow(code, is_then ? at.b : at.c, values_[at.y]);
  } else {
    Interval a = values_[at.a], b = values_[at.b], c = values_[at.c];
    bool is_everywhere = true;
    if constexpr (!operators::is_total<Operator>) is_everywhere = Operator::defined(a, b, c);
    if (needed_[at.y] == Need::value && is_everywhere) {
      for (const Register operand : {at.a, at.b}) needed_[operand] = std::max(needed_[operand], Need::value);
      return true;
    }
    Operator::backward(values_[at.y], a, b, c);
    return narrow(code, at.a, a) && (at.arity < 2 || narrow(code, at.b, b));
  }
}

bool Machine::backward(const Code& code, double best) {
  for (const Instruction& at : code.real_path) needed_[at.y] = Need::none;
  for (const Test& test : code.tests) {
    refuted_by_ = test.name;
    if (!narrow(code, test.reg, test.wanted)) return false;
  }
  if (!code.wanted.empty() && !narrow(code, code.wanted[0], Interval::raw(-kInfinity, best))) return false;
  const std::span<const Instruction> path = code.real_path;
  for (const Instruction *at = path.data(), *end = at + path.size(); at != end;) {
    const bool alive = with_operator(at->op, [&](auto known) {
      do {
        if (needed_[at->y] != Need::none &&
            !revise_one<decltype(known)::op, typename decltype(known)::type>(code, *at))
          return false;
      } while (++at != end && at->op == decltype(known)::op);
      return true;
    });
    if (!alive) return false;
  }
  return true;
}

}  // namespace hcsp::online
