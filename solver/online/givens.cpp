// SPDX-License-Identifier: Apache-2.0
#include "solver/online/givens.h"

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

#include "solver/online/schedule.h"
#include "solver/online/search.h"

namespace hcsp::online {

namespace {

constexpr std::size_t kAll = ~std::size_t{0};

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

  [[nodiscard]] static std::size_t count(const std::vector<std::uint8_t>& needed,
                                         const std::vector<std::uint8_t>& but) {
    std::size_t result = 0;
    for (std::size_t i = 0; i < needed.size(); ++i) result += needed[i] != 0 && but[i] == 0 ? 1 : 0;
    return result;
  }

  /// Those that are needed, in the order of the prefix.
  [[nodiscard]] std::vector<Instruction> select(const std::vector<std::uint8_t>& needed,
                                                const std::vector<std::uint8_t>& but = {}) const {
    std::vector<Instruction> result;
    for (std::size_t i = 0; i < needed.size(); ++i) {
      if (needed[i] != 0 && (but.empty() || but[i] == 0)) result.push_back(prefix_.code()[i]);
    }
    return result;
  }
  /// In a good order.
  [[nodiscard]] std::vector<Instruction> code(const std::vector<std::uint8_t>& needed,
                                              const std::vector<std::uint8_t>& but) const {
    std::vector<Instruction> result = select(needed, but);
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

// In parts, first the conditions that cost least: what refutes a case does mostly.
void give_prelude(const Needs& needs, const std::vector<std::uint8_t>& always, Code& code,
                  std::initializer_list<std::size_t> costs) {
  const std::vector<Register> registers = registers_of(code);
  std::vector<std::uint8_t> done = always;
  for (const std::size_t most : costs) {
    const auto is_dear = [&](const Test& test) { return Needs::count(needs.of({test.reg}), always) > most; };
    const auto dear =
        std::stable_partition(code.conditions.begin(), code.conditions.end(), std::not_fn(is_dear));
    Code::Part& part = code.prelude.emplace_back();
    part.conditions.assign(code.conditions.begin(), dear);
    code.conditions.erase(code.conditions.begin(), dear);
    const auto needed = needs.of(most == kAll ? registers : registers_of(part.conditions));
    part.code = needs.code(needed, done);
    for (std::size_t i = 0; i < done.size(); ++i) done[i] |= needed[i];
    if (part.code.empty() && part.conditions.empty()) code.prelude.pop_back();
  }
  for (const Register reg : registers) {
    if (reg < code.first()) code.reads.push_back(reg);
  }
  std::ranges::sort(code.reads);
  code.reads.erase(std::unique(code.reads.begin(), code.reads.end()), code.reads.end());
}

// Takes the conditions out of the searches for which nothing else has to be evaluated.
std::vector<Filter> take_filters(const Needs& needs, const std::vector<std::uint8_t>& always,
                                 std::vector<CompiledCase>& cases) {
  std::map<std::tuple<Key, std::uint32_t, bool>, Filter> filters;
  const auto is_evaluated = [&](const Test& test) { return Needs::count(needs.of({test.reg}), always) == 0; };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    std::erase_if(cases[i].search.conditions, [&](const Test& test) {
      if (!is_evaluated(test)) return false;
      Filter filter{test, CaseSet(cases.size())};
      filters.try_emplace({key_of(test), test.name, test.is_of_quotient}, std::move(filter))
          .first->second.cases.insert(i);
      return true;
    });
  }
  std::vector<Filter> result;
  for (auto& [key, filter] : filters) result.push_back(std::move(filter));
  std::ranges::stable_sort(result, std::greater{}, [](const Filter& one) { return one.cases.size(); });
  return result;
}

std::vector<Divisor> divisors_of(const std::vector<CompiledCase>& cases) {
  std::map<Register, CaseSet> divisors;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const Register reg : cases[i].search.nonzero)
      divisors.try_emplace(reg, cases.size()).first->second.insert(i);
  }
  std::vector<Divisor> result;
  for (auto& [reg, own] : divisors) result.push_back({reg, std::move(own)});
  return result;
}

// The registers that more than what is always evaluated reads.
std::set<Register> read_by_others(const Prefix& prefix, const std::vector<std::uint8_t>& always,
                                  const std::vector<CompiledCase>& cases, const Givens& givens) {
  std::set<Register> read;
  const auto add = [&](const std::vector<Register>& registers) {
    read.insert(registers.begin(), registers.end());
  };
  for (std::size_t i = 0; i < always.size(); ++i) {
    const Instruction& at = prefix.code()[i];
    if (always[i] == 0) read.insert({at.a, at.b, at.c});
  }
  for (const CompiledCase& one : cases) {
    add(registers_of(one.search));
    add(registers_of(one.proof));
  }
  for (const auto* tests : {&givens.required, &givens.reasons, &givens.certain}) add(registers_of(*tests));
  return read;
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
  givens.always = sections_of(needs.select(always), read_by_others(prefix, always, cases, givens));
  givens.late = needs.code(needs.of(registers_of(givens.reasons)), always);
  givens.proof = needs.code(needs.of(registers_of(givens.certain)), always);
  givens.filters = take_filters(needs, always, cases);
  givens.divisors = divisors_of(cases);
  for (CompiledCase& one : cases) {
    give_prelude(needs, always, one.search, {8, 32, 128, kAll});
    give_prelude(needs, always, one.proof, {kAll});
  }
  return givens;
}

}  // namespace hcsp::online
