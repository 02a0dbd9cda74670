// SPDX-License-Identifier: Apache-2.0
#include "solver/online/givens.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "solver/online/schedule.h"
#include "solver/online/search.h"

namespace hcsp::online {

namespace {

using Key = std::tuple<Register, double, double, bool>;
Key key_of(const Test& test) { return {test.reg, test.wanted.lo(), test.wanted.hi(), test.strict}; }

// Takes out the conditions that all codes have, whatever divisors are.
template <class CodeOf>
std::vector<Test> take_shared(std::vector<CompiledCase>& cases, CodeOf code_of) {
  std::map<Key, std::size_t> counts;
  for (CompiledCase& one : cases) {
    std::vector<Test>& conditions = code_of(one).conditions;
    std::map<Key, bool> seen;
    std::erase_if(conditions, [&](const Test& test) { return !seen.emplace(key_of(test), true).second; });
    for (const Test& test : conditions) counts[key_of(test)] += test.is_of_quotient ? 0 : 1;
  }
  const auto is_shared = [&](const Test& test) { return counts[key_of(test)] == cases.size(); };
  std::vector<Test> shared;
  if (!cases.empty())
    std::ranges::copy_if(code_of(cases[0]).conditions, std::back_inserter(shared), is_shared);
  for (CompiledCase& one : cases) std::erase_if(code_of(one).conditions, is_shared);
  return shared;
}

/// Which instructions of the prefix registers need.
class Needs {
 public:
  explicit Needs(const Prefix& prefix) : prefix_(prefix), producer_(prefix.size(), kNone) {
    for (std::size_t i = 0; i < prefix.code().size(); ++i) producer_[prefix.code()[i].y] = i;
  }

  std::vector<std::uint8_t> of(const std::vector<Register>& registers) const {
    std::vector<std::uint8_t> needed(prefix_.code().size());
    std::vector<Register> open = registers;
    while (!open.empty()) {
      const Register reg = open.back();
      open.pop_back();
      if (reg >= producer_.size() || producer_[reg] == kNone || needed[producer_[reg]] != 0) continue;
      needed[producer_[reg]] = 1;
      const Instruction& at = prefix_.code()[producer_[reg]];
      open.insert(open.end(), {at.a, at.b, at.c});
    }
    return needed;
  }

  [[nodiscard]] std::vector<Instruction> code(const std::vector<std::uint8_t>& needed,
                                              const std::vector<std::uint8_t>& but) const {
    std::vector<Instruction> result;
    for (std::size_t i = 0; i < needed.size(); ++i) {
      if (needed[i] != 0 && but[i] == 0) result.push_back(prefix_.code()[i]);
    }
    reorder(result, 0, [](const Instruction& at) { return at.op; });
    return result;
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  const Prefix& prefix_;
  std::vector<std::size_t> producer_;
};

std::vector<Register> registers_of(const std::vector<Test>& tests) {
  std::vector<Register> registers;
  for (const Test& test : tests) registers.push_back(test.reg);
  return registers;
}

std::vector<Register> registers_of(const Code& code) {
  std::vector<Register> registers = registers_of(code.conditions);
  for (const auto* part : {&code.values, &code.slopes, &code.rest, &code.further}) {
    for (const Instruction& at : *part) registers.insert(registers.end(), {at.a, at.b, at.c});
  }
  for (const ChainRule& rule : code.chain) registers.insert(registers.end(), {rule.sa, rule.sb});
  for (const CoreBound& bound : code.bounds) registers.push_back(bound.reg);
  for (const auto* part : {&code.nonzero, &code.definitions, &code.wanted})
    registers.insert(registers.end(), part->begin(), part->end());
  return registers;
}

// What many searches need, and what many tell cases apart by.
std::vector<std::uint8_t> needed_by_many(const Needs& needs, const std::vector<CompiledCase>& cases,
                                         std::vector<std::uint8_t> always) {
  constexpr double kMany = 0.3, kManyConditions = 0.1;
  std::vector<std::size_t> all(always.size()), conditions(always.size());
  for (const CompiledCase& one : cases) {
    const auto by_all = needs.of(registers_of(one.search));
    const auto by_conditions = needs.of(registers_of(one.search.conditions));
    for (std::size_t i = 0; i < always.size(); ++i) {
      all[i] += by_all[i];
      conditions[i] += by_conditions[i];
    }
  }
  const auto count = static_cast<double>(cases.size());
  for (std::size_t i = 0; i < always.size(); ++i) {
    const bool is_common = static_cast<double>(all[i]) >= kMany * count ||
                           static_cast<double>(conditions[i]) >= kManyConditions * count;
    if (is_common) always[i] = 1;
  }
  return always;
}

void give_prelude(const Needs& needs, const std::vector<std::uint8_t>& always, Code& code) {
  const std::vector<Register> registers = registers_of(code);
  code.prelude = needs.code(needs.of(registers), always);
  const auto is_quick = [&](const Test& test) {
    const auto needed = needs.of({test.reg});
    return std::ranges::equal(needed, always, [](std::uint8_t a, std::uint8_t b) { return a <= b; });
  };
  const auto slow = std::stable_partition(code.conditions.begin(), code.conditions.end(), is_quick);
  code.quick = static_cast<std::size_t>(slow - code.conditions.begin());
  for (const Register reg : registers) {
    if (reg < code.first()) code.reads.push_back(reg);
  }
  std::ranges::sort(code.reads);
  code.reads.erase(std::unique(code.reads.begin(), code.reads.end()), code.reads.end());
}

}  // namespace

Givens share_givens(const Prefix& prefix, std::vector<CompiledCase>& cases) {
  Givens givens;
  const Needs needs(prefix);
  const std::vector<Test> shared = take_shared(cases, [](CompiledCase& one) -> Code& { return one.search; });
  for (const Test& test : shared) (test.is_implied ? givens.reasons : givens.required).push_back(test);
  givens.certain = take_shared(cases, [](CompiledCase& one) -> Code& { return one.proof; });
  std::vector<Register> first = registers_of(givens.required);
  for (const CompiledCase& one : cases)
    first.insert(first.end(), one.search.nonzero.begin(), one.search.nonzero.end());
  const auto always = needed_by_many(needs, cases, needs.of(first));
  givens.always = needs.code(always, std::vector<std::uint8_t>(always.size()));
  givens.late = needs.code(needs.of(registers_of(givens.reasons)), always);
  givens.proof = needs.code(needs.of(registers_of(givens.certain)), always);
  for (CompiledCase& one : cases) {
    give_prelude(needs, always, one.search);
    give_prelude(needs, always, one.proof);
  }
  return givens;
}

}  // namespace hcsp::online
