// SPDX-License-Identifier: Apache-2.0
// The constraints of a Problem: each becomes one contractor or a few.
#include <cmath>

#include "solver/contractors/derivative.h"
#include "solver/contractors/disjoint.h"
#include "solver/contractors/meets.h"
#include "solver/contractors/refinement.h"
#include "solver/contractors/relation.h"
#include "solver/contractors/set_union.h"
#include "solver/contractors/sometime.h"
#include "solver/problem_impl.h"

namespace hcsp {

void Problem::constrain(std::string name, Expr relation) {
  impl_->state_relation(std::move(name), relation, false);
}

void Problem::imply(std::string name, Expr relation) {
  require(impl_->alternative == nullptr, "Problem: {} is implied within an alternative", name);
  impl_->state_relation(std::move(name), relation, true);
}

void Problem::choose_family(std::string name, Expr relation) {
  require(impl_->alternative == nullptr, "Problem: {} is of a family within an alternative", name);
  impl_->family.insert(name);
  impl_->state_relation(std::move(name), relation, false);
}

void Problem::Impl::state_relation(std::string stated, Expr relation, bool is_implied) {
  const NodeId node = relation_of(relation);
  if (phases != nullptr) return state_on_phases({std::move(stated), node, is_implied});
  if (alternative == nullptr) relations.push_back({stated, node, is_implied});
  state(make_relation_contractor(std::move(stated), dag, node, context()), true);
}

void Problem::constrain_sometime(std::string name, Expr relation) {
  impl_->require_all_time("some instant");
  impl_->state(
      make_sometime_contractor(std::move(name), impl_->dag, impl_->relation_of(relation), impl_->context()));
}

void Problem::during(const std::optional<Window>& window, const std::function<void()>& body) {
  impl_->require_all_time("a span of time");
  const Meanwhile at_hand(impl_->window, window ? impl_->items_of(*window) : nullptr);
  body();
}

void Problem::at_each_instant(std::string name, const std::function<void()>& body) {
  impl_->need_line();
  impl_->require_all_time("each instant");
  const ItemSet window = impl_->window ? *impl_->window : ItemSet::all(impl_->line->items());
  auto instant = std::make_shared<InstantAtHand>();
  ContractorGraph stated = [&] {
    const Meanwhile at_hand(impl_->window, std::shared_ptr<const ItemSet>(instant->item));
    const Meanwhile within(impl_->each_instant, instant);
    return impl_->alternative_of(body);
  }();
  impl_->state(
      make_each_instant_contractor(std::move(name), std::move(stated), *instant, impl_->line, window));
}

bool Problem::is_at_each_instant() const { return impl_->each_instant != nullptr; }

void Problem::constrain_at_least(std::string name, std::size_t least,
                                 const std::vector<std::function<void()>>& alternatives) {
  require(least >= 1 && least <= alternatives.size(), "Problem: at least {} of {} alternatives", least,
          alternatives.size());
  require(impl_->phases == nullptr, "Problem: {} is an alternative, on a time line with phases", name);
  std::vector<ContractorGraph> graphs;
  for (const auto& stated : alternatives) graphs.push_back(impl_->alternative_of(stated));
  impl_->state(make_alternatives_contractor(std::move(name), least, std::move(graphs)));
}

void Problem::constrain_derivative(std::string name, TubeVariable x, const VectorExpr& f) {
  if (impl_->phases != nullptr) {
    require(f.size() == x.dim, "Problem: der of a tube of dimension {} and {} components", x.dim, f.size());
    for (std::size_t c = 0; c < x.dim; ++c) constrain_derivative(name, x, c, f[c]);
    return;
  }
  impl_->need_line();
  impl_->require_all_time("a derivative");
  require(f.size() == x.dim, "Problem: der of a tube of dimension {} and {} components", x.dim, f.size());
  std::vector<NodeId> nodes;
  std::vector<std::size_t> components;
  for (const Expr& component : f) {
    components.push_back(nodes.size());
    nodes.push_back(impl_->node_of(component));
  }
  impl_->state(make_derivative_contractor(std::move(name), x.id, x.dim, std::move(components), impl_->dag,
                                          nodes, impl_->context()));
}

void Problem::constrain_derivative(std::string name, TubeVariable x, std::size_t component, Expr f) {
  require(component < x.dim, "Problem: component {} of {}", component + 1, x.dim);
  if (impl_->phases != nullptr) {
    const Input derived{Input::Kind::tube, x.id, static_cast<std::uint32_t>(component), 0};
    return impl_->state_on_phases({std::move(name), impl_->node_of(f), false, derived});
  }
  impl_->need_line();
  impl_->require_all_time("a derivative");
  impl_->state(make_derivative_contractor(std::move(name), x.id, x.dim, {component}, impl_->dag,
                                          {impl_->node_of(f)}, impl_->context()));
}

void Problem::constrain_union(std::string name, SetVariable set, const SetBuilder& zone) {
  require(zone.dim == set.dim, "Problem: a zone of R^{} for a set of R^{}", zone.dim, set.dim);
  impl_->state(make_union_contractor(name, name, set.id, impl_->graph.initial<SetInterval>(set.id),
                                     impl_->dag, impl_->relation_of(zone.relation, zone.dim),
                                     impl_->context(), impl_->fast_paths));
}

void Problem::constrain_disjoint(std::string name, SetVariable a, SetVariable b) {
  require(impl_->graph.initial<SetInterval>(a.id).grid() == impl_->graph.initial<SetInterval>(b.id).grid(),
          "Problem: disjoint sets need equal dimensions and precisions");
  impl_->state(make_disjoint_contractor(name, name, a.id, b.id));
}

double Problem::precision(SetVariable set) const {
  return impl_->graph.initial<SetInterval>(set.id).precision();
}

SetVariable Problem::hidden_set(std::string name, SetVariable like) {
  const SetInterval& model = impl_->graph.initial<SetInterval>(like.id);
  SetInterval domain(model.dim(), model.precision());
  domain.cover(model.reach());
  return {impl_->add(impl_->free_name(name), std::move(domain), DomainKind::set, true), like.dim};
}

SetVariable Problem::refined(SetVariable set, SetVariable like) {
  const Grid coarse = impl_->graph.initial<SetInterval>(set.id).grid();
  const Grid fine = impl_->graph.initial<SetInterval>(like.id).grid();
  int exponent = 0;
  const double mantissa = std::frexp(coarse.precision() / fine.precision(), &exponent);
  require(coarse.dim() == fine.dim() && mantissa == 0.5 && 1 <= exponent && exponent <= 21,
          "Problem: precisions {} and {}, where the first should be a power of two times the second",
          coarse.precision(), fine.precision());
  const auto known = impl_->refinements.find({set.id, fine.precision()});
  if (known != impl_->refinements.end()) return known->second;
  const std::string name = impl_->graph.variable(set.id).name() + " refined";
  SetVariable made{};
  const auto state = [&] {
    made = hidden_set(name, like);
    impl_->state(make_refinement_contractor(impl_->graph.variable(made.id).name(), made.id, set.id,
                                            1 << (exponent - 1)));
  };
  if (impl_->is_own_to_an_instant(set.id)) {
    state();
  } else {
    impl_->define(state);
    impl_->refinements.emplace(std::pair(set.id, fine.precision()), made);
  }
  return made;
}

void Problem::constrain_subset(std::string name, SetTerm a, SetTerm b) {
  impl_->require_one_grid({a, b});
  impl_->state(make_subset_contractor(name, name, a, b));
}

void Problem::constrain_intersection(std::string name, SetTerm whole, SetTerm a, SetTerm b) {
  impl_->require_one_grid({whole, a, b});
  impl_->state(make_intersection_contractor(name, name, whole, a, b));
}

void Problem::constrain_symmetric_difference(std::string name, SetTerm whole, SetTerm a, SetTerm b) {
  impl_->require_one_grid({whole, a, b});
  impl_->state(make_symmetric_difference_contractor(name, name, whole, a, b));
}

void Problem::constrain_common_point(std::string name, SetTerm a, SetTerm b) {
  impl_->require_one_grid({a, b});
  impl_->state(make_common_point_contractor(name, name, a, b));
}

void Problem::constrain_meets(std::string name, const SetBuilder& zone, SetVariable set) {
  require(zone.dim == set.dim, "Problem: a zone of R^{} for a set of R^{}", zone.dim, set.dim);
  impl_->state(make_meets_contractor(name, name, set.id, set.dim, impl_->dag,
                                     impl_->relation_of(zone.relation, zone.dim), impl_->context(),
                                     impl_->fast_paths));
}

void Problem::constrain_range(std::string name, Expr z, const VectorExpr& a, Expr delta, SetVariable map) {
  require(a.size() == map.dim, "Problem: a point of R^{} in a map of R^{}", a.size(), map.dim);
  impl_->node_of(z);
  impl_->node_of(delta, map.dim);
  const SetInterval& domain = impl_->graph.initial<SetInterval>(map.id);
  const VariableId dug =
      impl_->add(name + ".dug space", SetInterval(map.dim, domain.precision()), DomainKind::set, true);
  // Theorem 1 digs the open zone, delta < z: with the closed one it would contradict Theorem 2.
  impl_->state(make_union_contractor(name + ".dug", name, dug, impl_->graph.initial<SetInterval>(dug),
                                     impl_->dag, (delta < z).node(), impl_->context(), impl_->fast_paths));
  impl_->state(make_disjoint_contractor(name + ".free", name, dug, map.id));
  impl_->state(make_meets_contractor(name + ".impact", name, map.id, map.dim, impl_->dag, (delta == z).node(),
                                     impl_->context(), impl_->fast_paths));
}

}  // namespace hcsp
