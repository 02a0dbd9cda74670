// SPDX-License-Identifier: Apache-2.0
// The tubes of a time line with phases, and what is stated of them. An expression may take a tube at the time
// at hand, or at a gate, as on any time line; here each statement becomes a relation between reals in the
// end. A tube needs a definition: der(x) == f, with its value at the start if that is known, or x == f. Which
// of the statements are definitions shows when all are there; the others are relations.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "solver/phases/phase_error.h"
#include "solver/phases/phase_function.h"

namespace hcsp {

/// The time between two gates.
struct PhaseSpan {
  std::size_t from, to;
};

/// A relation, or "the derivative of a tube's component is an expression".
struct PhaseStatement {
  std::string name;
  NodeId expression;
  bool is_implied = false;
  std::optional<Input> derivative_of = {};  ///< the tube's component at the time at hand
  std::optional<PhaseSpan> span = {};       ///< it speaks of: of all the time where there is none
};

class PhaseTubes {
 public:
  /// `end` is the instant at the end of the last phase.
  PhaseTubes(Dag& dag, std::vector<Expr> durations, Expr end);

  [[nodiscard]] std::size_t phases() const { return durations_.size(); }
  [[nodiscard]] const std::vector<Expr>& durations() const { return durations_; }
  /// The instant after so many phases.
  [[nodiscard]] Expr gate(std::size_t k) const { return gates_[k]; }
  /// Which gate an instant is.
  [[nodiscard]] std::optional<std::size_t> gate_of(Expr instant) const;

  void declare(VariableId tube, std::string name, std::size_t dim);
  [[nodiscard]] std::size_t dim(VariableId tube) const { return dims_.at(tube); }
  /// Declares a tube that is values[i], of as many components, throughout phase i.
  void declare_hold(VariableId tube, std::string name, const std::vector<std::vector<Expr>>& values);

  /// What a statement says of reals; true where it is a definition.
  struct Expanded {
    std::string name;
    Expr relation;
    bool is_implied;
  };
  /// Finds the definitions among the statements and expands the others, in their order. `unknown_start` makes
  /// an unknown for the value of a tube at the start that no statement gives, by its name. Throws PhaseError.
  std::vector<Expanded> expand(const std::vector<PhaseStatement>& statements,
                               const std::function<Expr(const std::string&)>& unknown_start);
  /// An expression of reals in which tubes are taken at gates, after expand().
  Expr expand(Expr expression);
  /// A component of a tube, after expand().
  [[nodiscard]] const PhaseFunction& function(VariableId tube, std::size_t component) const;

 private:
  using Leaf = std::pair<VariableId, std::uint32_t>;  // a component of a tube
  struct Claim {
    std::size_t statement;
    NodeId expression;
    std::optional<Leaf> derivative_of;
    bool is_used = false;    // as a definition
    NodeId defined_by = {};  // then: what it equates
    void use(NodeId value) {
      is_used = true;
      defined_by = value;
    }
  };
  struct Component {
    std::string name;
    std::optional<PhaseFunction> function = {};
    std::vector<Expr> held = {};                           // by phase, of a tube that holds values
    bool is_at_hand = false;                               // being defined
    std::vector<std::pair<Claim*, NodeId>> equal_to = {};  // candidates, and what the component would be
    std::vector<Claim*> derivatives = {};
    std::vector<std::pair<Claim*, NodeId>> starts = {};
  };

  void collect_claims(const std::vector<PhaseStatement>& statements);
  void collect_conjuncts(const PhaseStatement& statement, std::size_t number, NodeId node);
  void collect_candidates(Claim& claim);
  [[nodiscard]] std::optional<Leaf> leaf_in(NodeId node, Input::Kind kind) const;
  [[nodiscard]] bool mentions_tubes(NodeId node) const;
  static std::vector<Expr> values_of_component(const std::vector<std::vector<Expr>>& values,
                                               std::size_t component);
  bool define(Component& component);
  bool define_by_values(Component& component);
  bool define_by_equation(Component& component);
  bool define_by_derivative(Component& component);
  bool can_define(NodeId expression);

  Expr definedness(const Claim& claim);
  Expr expanded_claim(const Claim& claim);
  Expr expanded_relation(NodeId node);
  Expr expanded_comparison(NodeId node);
  Expr expanded_at_gates(NodeId node);
  [[nodiscard]] PhaseFunction in_span(const PhaseFunction& function) const;
  PhaseFunction function_of(NodeId node);
  PhaseFunction function_of_node(NodeId node);
  [[nodiscard]] PhaseFunction function_of_time() const;
  [[noreturn]] void refuse(const std::string& message) const;
  [[nodiscard]] Expr expr(NodeId node) const { return {dag_, node}; }

  Dag& dag_;
  std::vector<Expr> durations_, gates_;
  std::map<Leaf, Component> components_;
  std::map<VariableId, std::size_t> dims_;  // by tube
  std::vector<std::unique_ptr<Claim>> claims_;
  std::map<NodeId, PhaseFunction> functions_;
  std::function<Expr(const std::string&)> unknown_start_;
  const std::vector<PhaseStatement>* statements_ = nullptr;
  std::optional<std::size_t> at_hand_;  // the statement that is being expanded
  std::optional<PhaseSpan> span_;       // and what of the time it speaks of
};

}  // namespace hcsp
