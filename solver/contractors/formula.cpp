// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/formula.h"

#include <algorithm>
#include <cmath>

#include "solver/contractors/in_at_least.h"
#include "solver/expression/connectives.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

// Relations that share parts may be far larger as formulas than as graphs. What is beyond this many atoms and
// connectives is contracted by plain HC4-revise.
constexpr std::size_t kLargestFormula = 10'000;

}  // namespace

class Formula::Maker {
 public:
  Maker(const Dag& dag, const Program& whole) : dag_(dag), whole_(whole) {}

  // Negations are pushed down to the atoms: a connective is true of what its operands are false of.
  Formula make(NodeId id, bool wanted) {
    const DagNode& node = dag_[id];
    if (++size_ > kLargestFormula) return atom(id, wanted);
    if (node.op == Op::logical_not) return make(node.operands[0], !wanted);
    // What holds for every value, or for some, holds for some value of the domain that the inputs give.
    if (is_quantifier(node.op)) return make(node.operands[1], wanted);
    if (node.op == Op::logical_and || node.op == Op::logical_or) {
      const std::vector<NodeId> relations = operands_of(dag_, id, node.op);
      return count(relations, node.op == Op::logical_and ? relations.size() : 1, wanted);
    }
    if (node.op == Op::less_equal && dag_[node.operands[0]].op == Op::constant) {
      const std::vector<NodeId> relations = counted_relations(dag_, node.operands[1], kLargestFormula);
      const double least = dag_[node.operands[0]].value.lo();
      if (relations.size() > 1 && least >= 1 && least <= static_cast<double>(relations.size()))
        return count(relations, static_cast<std::size_t>(std::ceil(least)), wanted);
    }
    return node.op == Op::if_then_else ? choice(node, wanted) : atom(id, wanted);
  }

 private:
  Formula choice(const DagNode& node, bool wanted) {
    Formula formula;
    formula.least_ = 1;
    for (const bool taken : {true, false}) {
      Formula& branch = formula.parts_.emplace_back(Formula());
      branch.least_ = 2;
      branch.parts_.push_back(make(node.operands[0], taken));
      branch.parts_.push_back(make(node.operands[taken ? 1 : 2], wanted));
    }
    return formula;
  }

  // At least `least` of n relations hold, or not: then at least n - least + 1 of them fail.
  Formula count(const std::vector<NodeId>& relations, std::size_t least, bool wanted) {
    Formula formula;
    formula.least_ = wanted ? least : relations.size() - least + 1;
    for (const NodeId relation : relations) formula.parts_.push_back(make(relation, wanted));
    return formula;
  }

  [[nodiscard]] Formula atom(NodeId id, bool wanted) const {
    Formula formula;
    formula.wanted_ = wanted;
    formula.atom_ = std::make_unique<Atom>(Program(dag_, {id}));
    const std::vector<Input>& inputs = whole_.inputs();
    for (const Input& input : formula.atom_->program.inputs())
      formula.atom_->places.push_back(
          static_cast<std::size_t>(std::find(inputs.begin(), inputs.end(), input) - inputs.begin()));
    return formula;
  }

  const Dag& dag_;
  const Program& whole_;
  std::size_t size_ = 0;
};

Formula::Formula(const Dag& dag, NodeId relation, const Program& whole)
    : Formula(Maker(dag, whole).make(relation, true)) {}

bool Formula::has_alternatives() const {
  return least_ < parts_.size() || std::any_of(parts_.begin(), parts_.end(),
                                               [](const Formula& part) { return part.has_alternatives(); });
}

bool Formula::contract(std::vector<Interval>& inputs) {
  return atom_ != nullptr ? contract_atom(inputs) : contract_parts(inputs);
}

bool Formula::contract_atom(std::vector<Interval>& inputs) {
  Evaluation& evaluation = atom_->evaluation;
  for (std::uint32_t i = 0; i < atom_->places.size(); ++i) evaluation.set(i, inputs[atom_->places[i]]);
  evaluation.forward();
  if (!evaluation.backward(wanted_ ? kTrue : kFalse)) return false;
  for (std::uint32_t i = 0; i < atom_->places.size(); ++i) inputs[atom_->places[i]] = evaluation.get(i);
  return true;
}

bool Formula::contract_parts(std::vector<Interval>& inputs) {
  if (least_ == parts_.size())
    return std::all_of(parts_.begin(), parts_.end(), [&](Formula& part) { return part.contract(inputs); });
  std::vector<std::vector<Interval>> left;
  for (Formula& part : parts_) {
    std::vector<Interval> own = inputs;
    if (part.contract(own)) left.push_back(std::move(own));
  }
  if (left.size() < least_) return false;
  std::vector<Interval> values(left.size());
  bool alive = true;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (std::size_t k = 0; k < left.size(); ++k) values[k] = left[k][i];
    inputs[i] = in_at_least(least_, values);
    alive = alive && !inputs[i].is_empty();
  }
  return alive;
}

}  // namespace hcsp
