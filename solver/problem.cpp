// SPDX-License-Identifier: Apache-2.0
#include "solver/problem.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "domains/check.h"
#include "domains/rounding.h"
#include "solver/contractors/alternatives.h"
#include "solver/contractors/delay.h"
#include "solver/contractors/derivative.h"
#include "solver/contractors/disjoint.h"
#include "solver/contractors/integrality.h"
#include "solver/contractors/meets.h"
#include "solver/contractors/refinement.h"
#include "solver/contractors/relation.h"
#include "solver/contractors/set_union.h"
#include "solver/contractors/sometime.h"
#include "solver/expression/operators.h"
#include "solver/problem_run.h"

namespace hcsp {

struct Problem::Impl {
  std::string name;
  ContractorGraph graph;
  Dag dag;
  std::vector<DomainKind> kinds;  // by variable
  std::shared_ptr<const TimeLine> line;
  std::shared_ptr<std::set<VariableId>> sampled = std::make_shared<std::set<VariableId>>();
  std::shared_ptr<Motions> motions = std::make_shared<Motions>();
  std::map<VariableId, std::vector<Reading>> readings;
  std::map<VariableId, Shape> shapes;  // where they differ from the default
  std::map<VariableId, VectorGroup> vectors;
  bool fast_paths = true;
  std::vector<std::unique_ptr<Contractor>>* alternative = nullptr;  // the one being stated
  std::map<std::pair<VariableId, NodeId>, VectorVariable> values;   // of tubes at instants to be found
  std::map<std::pair<std::vector<NodeId>, double>, VariableId> integrals;
  std::map<std::pair<VariableId, double>, VariableId> delayed;       // tubes, by the delay
  std::map<std::pair<VariableId, double>, SetVariable> refinements;  // by the finer grid's precision
  std::set<std::string> hidden_names;

  [[nodiscard]] Inputs::Context context() const { return {line, sampled, motions}; }

  template <Lattice D>
  VariableId add(const std::string& variable, D domain, DomainKind kind, bool hidden = false) {
    const VariableId id = graph.add_variable(variable, std::move(domain), hidden);
    kinds.push_back(kind);
    return id;
  }

  VectorVariable add_vector(const std::string& vector, const Box& domain, bool hidden = false) {
    const auto dim = static_cast<std::size_t>(domain.dim());
    require(dim > 0, "Problem: the vector {} has no components", vector);
    const auto first = static_cast<VariableId>(graph.variables().size());
    for (Eigen::Index i = 0; i < domain.dim(); ++i)
      add(fmt::format("{}[{}]", vector, i + 1), domain[i], DomainKind::real, hidden);
    vectors.emplace(first, VectorGroup{vector, dim});
    return {first, dim};
  }

  VectorExpr components(VectorVariable vector) {
    VectorExpr all;
    for (std::size_t i = 0; i < vector.dim; ++i) all.push_back(component(vector, i));
    return all;
  }

  Expr component(VectorVariable vector, std::size_t i) {
    return input(Input::Kind::real, vector.id + static_cast<VariableId>(i), 0);
  }

  Expr input(Input::Kind kind, VariableId variable, std::size_t component, std::size_t gate = 0) {
    const Input leaf{kind, variable, static_cast<std::uint32_t>(component), static_cast<std::uint32_t>(gate)};
    return {dag, dag.input(leaf)};
  }

  // A name for a hidden variable that no other has.
  std::string free_name(const std::string& wanted) {
    std::string name = wanted;
    for (std::size_t k = 2; !hidden_names.insert(name).second; ++k) name = fmt::format("{} #{}", wanted, k);
    return name;
  }

  // A contractor of the problem, or of the alternative that is being stated.
  void state(std::unique_ptr<Contractor> contractor) {
    if (alternative == nullptr) {
      graph.add_contractor(std::move(contractor));
    } else {
      alternative->push_back(std::move(contractor));
    }
  }

  // What an alternative says of a derivative, or of a tube at an instant, holds there alone.
  ContractorGraph alternative_of(const std::function<void()>& stated) {
    std::vector<std::unique_ptr<Contractor>> contractors;
    auto* outer = std::exchange(alternative, &contractors);
    const auto outer_motions = std::exchange(motions, std::make_shared<Motions>());
    const auto outer_values = values;
    const auto outer_integrals = integrals;
    const auto restore = [&] {
      values = outer_values;
      integrals = outer_integrals;
      alternative = outer;
      motions = outer_motions;
    };
    try {
      stated();
    } catch (...) {
      restore();
      throw;
    }
    restore();
    return graph.part(std::move(contractors));
  }

  [[nodiscard]] std::optional<ItemSet> items_of(const std::optional<Window>& window) const {
    if (!window) return {};
    need_line();
    const auto from = line->gate_at(window->from), to = line->gate_at(window->to);
    require(from && to && *from <= *to, "Problem: [{}, {}] is no span between instants of the time line",
            window->from, window->to);
    return ItemSet::range(2 * *from, 2 * *to);
  }

  VectorExpr inputs(Input::Kind kind, VariableId variable, std::size_t dim, std::size_t gate = 0) {
    VectorExpr vector;
    for (std::size_t c = 0; c < dim; ++c) vector.push_back(input(kind, variable, c, gate));
    return vector;
  }

  // The node of an expression of this problem that uses no bound point beyond R^point_dim.
  NodeId node_of(Expr expression, std::size_t point_dim = 0) const {
    require(&expression.dag() == &dag, "Problem: the expression belongs to another problem");
    const Program program(dag, {expression.node()});
    for (const Input& input : program.inputs()) {
      require(input.kind != Input::Kind::point || input.component < point_dim,
              "Problem: the bound point's component {} is free here", input.component + 1);
    }
    return expression.node();
  }

  NodeId relation_of(Expr relation, std::size_t point_dim = 0) const {
    const NodeId node = node_of(relation, point_dim);
    require(holds_or_not(node), "Problem: the expression is no relation");
    return node;
  }

  [[nodiscard]] bool holds_or_not(NodeId id) const {
    const DagNode& node = dag[id];
    if (node.op != Op::if_then_else) return is_boolean(node.op);
    return holds_or_not(node.operands[1]) && holds_or_not(node.operands[2]);
  }

  void require_one_grid(const std::vector<SetTerm>& terms) {
    for (const SetTerm& term : terms) {
      require(graph.initial<SetInterval>(term.set).grid() == graph.initial<SetInterval>(terms[0].set).grid(),
              "Problem: sets that meet in a relation need equal dimensions and precisions");
    }
  }

  void need_line() const { require(line != nullptr, "Problem: set_time_line comes before the first tube"); }
};

Problem::Problem(std::string name) : impl_(std::make_unique<Impl>()) { impl_->name = std::move(name); }
Problem::~Problem() = default;

RealVariable Problem::real(std::string name, const Interval& domain) {
  return {impl_->add(name, domain, DomainKind::real)};
}

IntegerVariable Problem::integer(std::string name, const Interval& domain) {
  const VariableId id = impl_->add(name, domain, DomainKind::real);
  impl_->shapes[id].scalar = Shape::Scalar::whole;
  impl_->state(make_integrality_contractor(name + " is whole", id));
  return {id};
}

BooleanVariable Problem::boolean(std::string name) {
  const VariableId id = integer(std::move(name), Interval(0.0, 1.0)).id;
  impl_->shapes[id].scalar = Shape::Scalar::boolean;
  return {id};
}

VectorVariable Problem::vector(std::string name, const Box& domain) {
  return impl_->add_vector(name, domain);
}

void Problem::set_time_line(TimeLine line) {
  require(impl_->line == nullptr, "Problem: there is one time line, and it is set already");
  impl_->line = std::make_shared<const TimeLine>(std::move(line));
}

const std::shared_ptr<const TimeLine>& Problem::time_line() const { return impl_->line; }

TubeVariable Problem::tube(std::string name, std::size_t dim) {
  impl_->need_line();
  return tube(std::move(name), Tube(impl_->line, dim));
}

TubeVariable Problem::tube(std::string name, const Tube& domain) {
  impl_->need_line();
  require(domain.line() == *impl_->line, "Problem: the tube {} stands on another time line", name);
  return {impl_->add(name, domain, DomainKind::tube), domain.dim()};
}

void Problem::set_readings(TubeVariable tube, std::vector<Reading> readings) {
  impl_->need_line();
  for (const Reading& reading : readings) {
    require(reading.gate <= impl_->line->slices(), "Problem: there is no gate {}", reading.gate);
  }
  impl_->sampled->insert(tube.id);
  impl_->readings[tube.id] = std::move(readings);
}

SetVariable Problem::set(std::string name, std::size_t dim, double precision,
                         const std::optional<Box>& frame) {
  return {impl_->add(name, SetInterval(dim, precision, frame), DomainKind::set), dim};
}

VectorVariable Problem::matrix(std::string name, std::size_t rows, const Box& domain) {
  const auto components = static_cast<std::size_t>(domain.dim());
  require(rows > 0 && components > 0 && components % rows == 0, "Problem: {} components in {} rows",
          components, rows);
  const VectorVariable matrix = vector(std::move(name), domain);
  impl_->shapes[matrix.id].columns = components / rows;
  return matrix;
}

void Problem::place_in_array(VariableId element, std::string array, std::vector<int> indices) {
  impl_->shapes[element].array = std::move(array);
  impl_->shapes[element].indices = std::move(indices);
}

Expr Problem::component(VectorVariable x, std::size_t i) {
  require(i < x.dim, "Problem: component {} of {}", i + 1, x.dim);
  return impl_->component(x, i);
}

Expr Problem::constant(const Interval& value) { return {impl_->dag, impl_->dag.constant(value)}; }
Expr Problem::operator()(RealVariable x) { return impl_->input(Input::Kind::real, x.id, 0); }
Expr Problem::operator()(IntegerVariable x) { return impl_->input(Input::Kind::real, x.id, 0); }
// Between the two values, so that either truth of the relation leaves but one of them.
Expr Problem::operator()(BooleanVariable x) {
  return impl_->input(Input::Kind::real, x.id, 0) > Interval(0.5);
}
VectorExpr Problem::operator()(VectorVariable x) { return impl_->components(x); }
VectorExpr Problem::operator()(TubeVariable x) { return impl_->inputs(Input::Kind::tube, x.id, x.dim); }

VectorExpr Problem::at(TubeVariable x, double t) {
  impl_->need_line();
  const auto gate = impl_->line->gate_at(t);
  require(gate.has_value(), "Problem: {} is not an instant of the time line", t);
  return impl_->inputs(Input::Kind::gate, x.id, x.dim, *gate);
}

VectorExpr Problem::at(TubeVariable x, Expr instant) {
  impl_->need_line();
  const NodeId node = impl_->node_of(instant);
  const Program program(impl_->dag, {node});
  for (const Input& input : program.inputs()) {
    require(input.kind != Input::Kind::tube && input.kind != Input::Kind::time,
            "Problem: an instant that varies with time");
  }
  const auto known = impl_->values.find({x.id, node});
  if (known != impl_->values.end()) return impl_->components(known->second);
  const std::string name = fmt::format("{} at instant {}", impl_->graph.variable(x.id).name(), node);
  const VectorVariable value =
      impl_->add_vector(impl_->free_name(name), Box(static_cast<Eigen::Index>(x.dim)), true);
  impl_->values.emplace(std::pair(x.id, node), value);
  const VectorExpr found = impl_->components(value);
  constrain_sometime(name, time() == instant && found == (*this)(x));
  return found;
}

VectorExpr Problem::delayed(TubeVariable x, double delay) {
  impl_->need_line();
  require(std::isfinite(delay), "Problem: a delay of {}", delay);
  const auto known = impl_->delayed.find({x.id, delay});
  if (known != impl_->delayed.end()) return impl_->inputs(Input::Kind::tube, known->second, x.dim);
  const std::string name = impl_->free_name(
      fmt::format("{}(t {} {})", impl_->graph.variable(x.id).name(), delay < 0 ? "+" : "-", std::abs(delay)));
  const VariableId value = impl_->add(name, Tube(impl_->line, x.dim), DomainKind::tube, true);
  // It is what it is whatever holds: no alternative owns this.
  impl_->graph.add_contractor(make_delay_contractor(name, value, x.id, *impl_->line, delay));
  impl_->delayed.emplace(std::pair(x.id, delay), value);
  return impl_->inputs(Input::Kind::tube, value, x.dim);
}

TubeVariable Problem::integral(const VectorExpr& f, double from) {
  impl_->need_line();
  const auto start = impl_->line->gate_at(from);
  require(start.has_value(), "Problem: {} is not an instant of the time line", from);
  std::vector<NodeId> nodes;
  for (const Expr& component : f) nodes.push_back(impl_->node_of(component));
  const auto known = impl_->integrals.find({nodes, from});
  if (known != impl_->integrals.end()) return {known->second, f.size()};
  const std::string name = impl_->free_name(fmt::format("integral from {}", from));
  Tube domain(impl_->line, f.size());
  for (std::size_t c = 0; c < f.size(); ++c) domain.set(c, 2 * *start, 0.0);
  const VariableId value = impl_->add(name, std::move(domain), DomainKind::tube, true);
  impl_->integrals.emplace(std::pair(nodes, from), value);
  constrain_derivative(name, {value, f.size()}, f);
  return {value, f.size()};
}

Expr Problem::instant(std::string name, const std::optional<Window>& window) {
  impl_->need_line();
  const TimeLine& line = *impl_->line;
  const Interval span = window ? Interval(window->from, window->to) : Interval(line.start(), line.end());
  return impl_->input(Input::Kind::real, impl_->add(impl_->free_name(name), span, DomainKind::real, true), 0);
}

Expr Problem::time() {
  impl_->need_line();
  return impl_->input(Input::Kind::time, 0, 0);
}

VectorExpr Problem::point(std::size_t dim) { return impl_->inputs(Input::Kind::point, 0, dim); }

void Problem::constrain(std::string name, Expr relation, const std::optional<Window>& window) {
  impl_->state(make_relation_contractor(std::move(name), impl_->dag, impl_->relation_of(relation),
                                        impl_->context(), impl_->items_of(window)));
}

void Problem::constrain_sometime(std::string name, Expr relation, const std::optional<Window>& window) {
  impl_->state(make_sometime_contractor(std::move(name), impl_->dag, impl_->relation_of(relation),
                                        impl_->context(), impl_->items_of(window)));
}

void Problem::constrain_at_least(std::string name, std::size_t least,
                                 const std::vector<std::function<void()>>& alternatives) {
  require(least >= 1 && least <= alternatives.size(), "Problem: at least {} of {} alternatives", least,
          alternatives.size());
  std::vector<ContractorGraph> graphs;
  for (const auto& stated : alternatives) graphs.push_back(impl_->alternative_of(stated));
  impl_->state(make_alternatives_contractor(std::move(name), least, std::move(graphs)));
}

void Problem::constrain_derivative(std::string name, TubeVariable x, const VectorExpr& f) {
  impl_->need_line();
  require(f.size() == x.dim, "Problem: der of a tube of dimension {} and {} components", x.dim, f.size());
  std::vector<NodeId> nodes;
  std::vector<std::size_t> components;
  for (const Expr& component : f) {
    components.push_back(nodes.size());
    nodes.push_back(impl_->node_of(component));
  }
  impl_->state(make_derivative_contractor(std::move(name), x.id, std::move(components), impl_->dag, nodes,
                                          impl_->context()));
}

void Problem::constrain_derivative(std::string name, TubeVariable x, std::size_t component, Expr f) {
  impl_->need_line();
  require(component < x.dim, "Problem: component {} of {}", component + 1, x.dim);
  impl_->state(make_derivative_contractor(std::move(name), x.id, {component}, impl_->dag, {impl_->node_of(f)},
                                          impl_->context()));
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
  const SetVariable made = hidden_set(name, like);
  // It is the same set whatever holds: no alternative owns this.
  impl_->graph.add_contractor(make_refinement_contractor(impl_->graph.variable(made.id).name(), made.id,
                                                         set.id, 1 << (exponent - 1)));
  impl_->refinements.emplace(std::pair(set.id, fine.precision()), made);
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

void Problem::use_fast_paths(bool use) { impl_->fast_paths = use; }
const std::string& Problem::name() const { return impl_->name; }
const ContractorGraph& Problem::graph() const { return impl_->graph; }

Result Problem::propagate(const PropagationOptions& options) {
  return run_problem(
      {impl_->name, impl_->graph, impl_->kinds, impl_->line, impl_->readings, impl_->shapes, impl_->vectors},
      options);
}

}  // namespace hcsp
