// SPDX-License-Identifier: Apache-2.0
#include "solver/search/separator.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "solver/expression/operators.h"

namespace hcsp {

namespace {

// With which truths the quantifiers of a relation are needed.
class Polarity {
 public:
  explicit Polarity(const PointSet& set) : set_(set), is_(set.size()) {}

  void visit(NodeId id, bool wanted) {
    if (!seen_.emplace(id, wanted).second) return;
    const DagNode& node = set_.dag[id];
    if (is_quantifier(node.op)) {
      auto& its = is_[set_.place_of(set_.dag[node.operands[0]].input)];
      ((node.op == Op::for_every) == wanted ? its.universal : its.existential) = true;
      return visit(node.operands[1], wanted);
    }
    if (node.op == Op::logical_not) return visit(node.operands[0], !wanted);
    const bool keeps = node.op == Op::logical_and || node.op == Op::logical_or;
    for (int k = 0; k < operator_entry(node.op).arity; ++k) {
      visit(node.operands[static_cast<std::size_t>(k)], wanted);
      if (!keeps) visit(node.operands[static_cast<std::size_t>(k)], !wanted);
    }
  }
  [[nodiscard]] bool is_universal(std::size_t v) const { return is_[v].universal && !is_[v].existential; }

 private:
  struct Uses {
    bool universal = false, existential = false;
  };
  const PointSet& set_;
  std::vector<Uses> is_;
  std::set<std::pair<NodeId, bool>> seen_;
};

}  // namespace

std::vector<std::uint8_t> Separator::universals_of(const PointSet& set, bool wanted) {
  Polarity polarity(set);
  polarity.visit(set.relation, wanted);
  std::vector<std::uint8_t> universals(set.size());
  for (std::size_t v = set.dim; v < set.size(); ++v) universals[v] = polarity.is_universal(v) ? 1 : 0;
  return universals;
}

Separator::Separator(const PointSet& set)
    : set_(set),
      sides_{Side{{set, set.dag.apply(Op::logical_not, {set.relation}, 1)}, universals_of(set, false)},
             Side{{set, set.relation}, universals_of(set, true)}} {}

// The middle, and the ends. What holds for every value holds for some, where none is known.
Interval Separator::value_to_try(std::size_t unknown, int attempt) const {
  const Interval& certain = set_.unknowns[unknown].certain_part();
  if (certain.is_empty()) return set_.unknowns[unknown].domain;
  const double middle = set_.unknowns[unknown].is_whole ? std::floor(cut_of(certain)) : cut_of(certain);
  const double value = attempt == 0 ? middle : attempt == 1 ? certain.lo() : certain.hi();
  return std::isfinite(value) ? Interval::raw(value, value) : Interval::raw(middle, middle);
}

bool Separator::contract(std::span<Interval> box, bool wanted) {
  Side& side = sides_[wanted ? 1 : 0];
  const auto& universal = side.is_universal;
  const bool has_universals = std::find(universal.begin(), universal.end(), 1) != universal.end();
  const int attempts = has_universals ? 3 : 1;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    extended_.assign(box.begin(), box.end());
    for (std::size_t v = set_.dim; v < set_.size(); ++v)
      extended_.push_back(universal[v] != 0 ? value_to_try(v, attempt) : set_.unknowns[v].domain);
    if (!side.narrowing.contract(extended_)) return false;
    std::copy_n(extended_.begin(), set_.dim, box.begin());
  }
  return true;
}

}  // namespace hcsp
