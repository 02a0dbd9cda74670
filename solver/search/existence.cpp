// SPDX-License-Identifier: Apache-2.0
#include "solver/search/existence.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

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

bool Existence::holds(std::span<const Interval> box) {
  point_.assign(box.size(), Interval::raw(0.0, 0.0));
  around_ = point_;
  for (std::size_t v = 0; v < box.size(); ++v) {
    if (!is_solved_for_[v]) continue;
    if (!box[v].is_bounded()) return false;
    const double middle = middle_of(box[v]);
    point_[v] = Interval::raw(middle, middle);
    around_[v] = box[v];
  }
  if (!approach_solution()) return false;
  for (const std::uint32_t v : own_) {
    if (!set_.unknowns[v].is_whole) around_[v] = point_[v];
  }
  if (!newton_.prove_some(around_)) return false;
  around_ = newton_.enclosure();
  for (std::size_t v = 0; v < around_.size(); ++v) {
    if (!is_solved_for_[v]) around_[v] = box[v];
  }
  // An own unknown that no equation depends on may have any value.
  for (const std::uint32_t v : own_) {
    if (is_solved_for_[v]) continue;
    const double middle = set_.unknowns[v].is_whole ? std::floor(cut_of(box[v])) : cut_of(box[v]);
    around_[v] = Interval::raw(middle, middle);
  }
  if (!lies_within(around_)) return false;
  Verdict verdict = Verdict::yes;
  if (rest_ != nullptr) rest_->decide(around_, {&verdict, 1});
  return verdict == Verdict::yes;
}

// Newton's iteration in plain numbers with the outer unknowns in the middle of their domains; where there are
// more own unknowns than equations, by the least steps.
bool Existence::approach_solution() {
  constexpr int kMostSteps = 10;
  constexpr double kNear = 1e-10;
  const auto equations = static_cast<Eigen::Index>(forms_.size()),
             size = static_cast<Eigen::Index>(own_.size());
  Eigen::MatrixXd jacobian(equations, size);
  Eigen::VectorXd value(equations);
  for (int step = 0; step < kMostSteps; ++step) {
    forms_.expand_over(point_);
    forms_.evaluate_at_center();
    for (std::uint32_t e = 0; e < forms_.size(); ++e) {
      if (!forms_.has_form(e)) return false;
      constexpr double kOnce = 1.0;
      value[e] = middle_of(forms_.combine({&e, 1}, {&kOnce, 1}).value);
      for (Eigen::Index k = 0; k < size; ++k) {
        const std::uint32_t v = own_[static_cast<std::size_t>(k)];
        jacobian(e, k) = set_.unknowns[v].is_whole ? 0.0 : middle_of(forms_.slopes(e)[v]);
      }
    }
    const Eigen::VectorXd change = jacobian.completeOrthogonalDecomposition().solve(value);
    if (!change.allFinite()) return false;
    for (Eigen::Index k = 0; k < size; ++k) {
      const std::uint32_t v = own_[static_cast<std::size_t>(k)];
      const Interval& domain = set_.unknowns[v].domain;
      const double moved = std::clamp(point_[v].lo() - change[k], domain.lo(), domain.hi());
      if (!set_.unknowns[v].is_whole) point_[v] = Interval::raw(moved, moved);
    }
    if (change.norm() <= kNear) break;
  }
  return true;
}

bool Existence::lies_within(const std::vector<Interval>& enclosure) const {
  return std::all_of(own_.begin(), own_.end(), [&](std::uint32_t v) {
    const Interval& side = enclosure[v];
    return (side.is_point() || !set_.unknowns[v].is_whole) && leq(side, set_.unknowns[v].certain_part());
  });
}

}  // namespace hcsp
