// SPDX-License-Identifier: Apache-2.0
#include "solver/search/existence.h"

#include <algorithm>

#include "solver/expression/connectives.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

// The unknowns of a set, of which only some are solved for.
std::vector<System::Unknown> solved_for(const PointSet& set, const std::vector<std::uint32_t>& own) {
  std::vector<System::Unknown> unknowns = set.unknowns;
  for (System::Unknown& unknown : unknowns) unknown.is_given = true;
  for (const std::uint32_t v : own) unknowns[v].is_given = unknowns[v].is_whole;
  return unknowns;
}

}  // namespace

std::unique_ptr<Existence> Existence::of(const PointSet& set, NodeId relation,
                                         const std::vector<std::uint32_t>& outer,
                                         const std::vector<std::uint32_t>& own) {
  Dag& dag = set.dag;
  std::vector<NodeId> equations;
  std::optional<NodeId> rest;
  for (const NodeId part : operands_of(dag, relation, Op::logical_and)) {
    const DagNode& node = dag[part];
    if (node.op == Op::equal && fits_tape(dag, node.operands[0]) && fits_tape(dag, node.operands[1])) {
      equations.push_back(part);
    } else {
      rest = rest ? dag.apply(Op::logical_and, {*rest, part}, 2) : part;
    }
  }
  if (equations.empty() || equations.size() > own.size()) return nullptr;
  std::vector<std::uint32_t> around = outer;
  around.insert(around.end(), own.begin(), own.end());
  return std::unique_ptr<Existence>(
      new Existence(set, equations, rest ? make_part(set, *rest, around) : nullptr, outer, own));
}

Existence::Existence(const PointSet& set, const std::vector<NodeId>& equations,
                     std::unique_ptr<Membership::Part> rest, const std::vector<std::uint32_t>& outer,
                     const std::vector<std::uint32_t>& own)
    : set_(set),
      outer_(outer),
      own_(own),
      system_(set.dag, equations, solved_for(set, own)),
      forms_(system_),
      newton_(system_, forms_),
      rest_(std::move(rest)),
      is_solved_for_(set.size()) {
  for (std::size_t e = 0; e < forms_.size(); ++e) {
    for (const std::uint32_t v : forms_.unknowns(e)) is_solved_for_[v] = 1;
  }
}

bool Existence::holds(std::span<const Interval> box, Narrowing& narrowing) {
  // Near the solutions at the middle of the box.
  guess_.assign(box.begin(), box.end());
  for (const std::uint32_t v : outer_) {
    if (!guess_[v].is_bounded()) return false;
    const double middle = middle_of(guess_[v]);
    if (!set_.unknowns[v].is_whole) guess_[v] = Interval::raw(middle, middle);
  }
  if (!narrowing.contract(guess_)) return false;
  around_.assign(box.begin(), box.end());
  for (const std::uint32_t v : own_) around_[v] = guess_[v];
  for (std::size_t v = 0; v < around_.size(); ++v) {
    if (!is_solved_for_[v]) around_[v] = Interval::raw(0.0, 0.0);
  }
  if (!newton_.prove_some(around_)) return false;
  around_ = newton_.enclosure();
  for (std::size_t v = 0; v < around_.size(); ++v) {
    if (!is_solved_for_[v]) around_[v] = box[v];
  }
  // An own unknown that no equation depends on may have any value.
  for (const std::uint32_t v : own_) {
    if (is_solved_for_[v]) continue;
    const double middle = cut_of(guess_[v]);
    around_[v] = set_.unknowns[v].is_whole ? whole_numbers_of(Interval::raw(middle - 0.5, middle + 0.5))
                                           : Interval::raw(middle, middle);
  }
  if (!lies_within(around_)) return false;
  Verdict verdict = Verdict::yes;
  if (rest_ != nullptr) rest_->decide(around_, {&verdict, 1});
  return verdict == Verdict::yes;
}

bool Existence::lies_within(const std::vector<Interval>& enclosure) const {
  return std::all_of(own_.begin(), own_.end(), [&](std::uint32_t v) {
    const Interval &side = enclosure[v], &domain = set_.unknowns[v].domain;
    if (set_.unknowns[v].is_whole) return side.is_point() && leq(side, domain);
    // A literal may leave open whether the domain has its ends.
    return side == domain ? domain.is_point() : domain.lo() < side.lo() && side.hi() < domain.hi();
  });
}

}  // namespace hcsp
