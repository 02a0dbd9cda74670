// SPDX-License-Identifier: Apache-2.0
// What a Problem holds, and what its functions share. Internal to the solver.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <utility>

#include "domains/check.h"
#include "solver/contractors/alternatives.h"
#include "solver/contractors/each_instant.h"
#include "solver/contractors/inputs.h"
#include "solver/expression/operators.h"
#include "solver/phases/enclosure.h"
#include "solver/phases/phase_tubes.h"
#include "solver/problem.h"
#include "solver/problem_run.h"
#include "solver/search/point_set.h"

namespace hcsp {

// A member that has another value for a while.
template <class Member>
class Meanwhile {
 public:
  Meanwhile(Member& member, Member value)
      : member_(member), before_(std::exchange(member, std::move(value))) {}
  Meanwhile(const Meanwhile&) = delete;
  Meanwhile& operator=(const Meanwhile&) = delete;
  ~Meanwhile() { member_ = std::move(before_); }

 private:
  Member& member_;
  Member before_;
};

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
  struct Stated {
    std::string name;
    NodeId relation;
    bool is_implied;
  };
  std::vector<Stated> relations;          // those that hold whatever else does
  std::set<std::string> family;           // names of those that other solutions may not obey
  std::set<VariableId> parameters;        // numbers that are given
  std::map<VariableId, NodeId> followed;  // by parameter: what its value is unless it is set
  std::map<VariableId, std::optional<NodeId>> values_of_parameters;  // as constants
  std::map<VariableId, Interval> certain;  // domains whose ends are no doubles: what is inside of them
  std::set<VariableId> whole;              // the whole numbers and Booleans
  std::set<VariableId> bound;              // by quantifiers over reals
  bool is_system = true;                   // nothing but relations and whole numbers was stated
  std::unique_ptr<PhaseTubes> phases;      // where the time line is made of phases
  std::vector<PhaseStatement> statements;  // with phases: relations before they are expanded
  std::optional<PhaseSpan> span;           // with phases: of the time at hand
  mutable std::map<VariableId, TubeEnclosure> enclosures;  // of tubes that were asked for
  bool is_expanded = false;                                // with phases: they were
  std::shared_ptr<const ItemSet> window;                   // the items at hand; null for all
  std::shared_ptr<InstantAtHand> each_instant{};           // of at_each_instant()

  [[nodiscard]] Inputs::Context context() const { return {line, sampled, motions, window}; }

  template <Lattice D>
  VariableId add(const std::string& variable, D domain, DomainKind kind, bool hidden = false) {
    const VariableId id = graph.add_variable(variable, std::move(domain), hidden);
    kinds.push_back(kind);
    if (each_instant != nullptr) each_instant->own.insert(id);
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
  void state(std::unique_ptr<Contractor> contractor, bool of_system = false) {
    require(phases == nullptr || of_system, "Problem: {} is no relation, on a time line with phases",
            contractor->name());
    is_system = is_system && of_system;
    if (alternative == nullptr) {
      graph.add_contractor(std::move(contractor));
    } else {
      alternative->push_back(std::move(contractor));
    }
  }

  void state_relation(std::string stated, Expr relation, bool is_implied);
  void state_on_phases(PhaseStatement statement);
  TubeVariable add_phase_tube(const std::string& tube, std::size_t dim);
  void expand_phases();

  // What an alternative says of a derivative, or of a tube at an instant, holds there alone.
  ContractorGraph alternative_of(const std::function<void()>& stated) {
    std::vector<std::unique_ptr<Contractor>> contractors;
    {
      const Meanwhile its_own(alternative, &contractors);
      const Meanwhile its_motions(motions, std::make_shared<Motions>());
      const Meanwhile known_values(values, decltype(values)(values));
      const Meanwhile known_integrals(integrals, decltype(integrals)(integrals));
      stated();
    }
    return graph.part(std::move(contractors));
  }

  // A relation with a real of its own, which nothing else may speak of.
  Expr quantified(Op quantifier, const std::string& real, const Interval& domain,
                  const std::function<Expr(Expr)>& relation, const std::optional<Interval>& certain_domain) {
    const VariableId own = add(free_name(real), domain, DomainKind::real, true);
    bound.insert(own);
    if (certain_domain) certain[own] = *certain_domain;
    const Expr input_of = input(Input::Kind::real, own, 0);
    const NodeId body = relation_of(relation(input_of));
    return {dag, dag.apply(quantifier, {input_of.node(), body}, 2)};
  }
  PointSet point_set_of(const std::vector<Expr>& variables);

  // The value of an expression of parameters.
  [[nodiscard]] Interval value_of_parameters(NodeId id) const;
  // An expression with what is given in the place of the parameters.
  [[nodiscard]] NodeId with_values_of_parameters(NodeId id);
  // The relations of a problem of reals as searches take them: those stated, and a false one where a domain
  // is empty, which no relation need speak of; and those that are implied. What is given is a constant in
  // them.
  struct SearchRelations {
    std::vector<NodeId> stated, implied;
  };
  [[nodiscard]] SearchRelations relations_of_search();

  [[nodiscard]] std::shared_ptr<const ItemSet> items_of(const Window& span) const {
    need_line();
    const auto from = line->gate_at(span.from), to = line->gate_at(span.to);
    require(from && to && *from <= *to, "Problem: [{}, {}] is no span between instants of the time line",
            span.from, span.to);
    return std::make_shared<const ItemSet>(ItemSet::range(2 * *from, 2 * *to));
  }

  // Runs body() as if outside all alternatives, instants and windows: what it states is a definition, which
  // is what it is whatever else holds.
  template <class Body>
  void define(Body body) {
    const Meanwhile no_alternative(alternative, static_cast<decltype(alternative)>(nullptr));
    const Meanwhile all_time(window, decltype(window)());
    const Meanwhile no_instant(each_instant, decltype(each_instant)());
    body();
  }

  [[nodiscard]] bool is_own_to_an_instant(VariableId v) const {
    return each_instant != nullptr && each_instant->own.contains(v);
  }

  void require_all_time(std::string_view what) const {
    require(each_instant == nullptr, "Problem: {} speaks of more than the instant at hand", what);
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

  [[nodiscard]] ProblemView view() const {
    return {
        name, graph, kinds, line, readings, shapes, vectors, [this](VariableId tube, const auto& value_of) {
          const auto known = enclosures.try_emplace(tube, dag, *phases, tube).first;
          return Domain(known->second.on(value_of));
        }};
  }

  void need_line() const {
    require(phases == nullptr, "Problem: this needs a time line of known instants, and this one has phases");
    require(line != nullptr, "Problem: set_time_line comes before the first tube");
  }
};

}  // namespace hcsp
