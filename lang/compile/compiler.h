// SPDX-License-Identifier: Apache-2.0
// The compiler's state. Its functions are spread over unknowns.cpp (the time line and the unknowns),
// constraints.cpp, logic.cpp and sets.cpp.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "domains/check.h"
#include "lang/compile/tube_plan.h"
#include "lang/evaluate/evaluator.h"
#include "lang/model/model.h"

namespace hcsp::lang {

/// Whether a symbol is an unknown of the problem.
bool is_unknown(const Symbol& symbol);

class Compiler {
 public:
  /// `further` are instants of the time line that the model does not spell out.
  Compiler(Model& model, std::vector<double> further)
      : model_(model),
        further_(std::move(further)),
        problem_(std::make_unique<Problem>(model.name)),
        unknowns_{*problem_, {}},
        evaluator_(model, unknowns_, [this](const Expr& expr) { return truth_of(expr); }) {}

  std::unique_ptr<Problem> run();
  /// Those that the constraints turned out to need besides.
  [[nodiscard]] const std::vector<double>& missing_instants() const { return evaluator_.missing_instants(); }

 private:
  // The time line and the unknowns.
  void check_goal();
  void find_paved();
  void find_objective();
  void plan_tubes();
  bool make_time_line();
  [[nodiscard]] bool is_planned(const Expr& domain) const;
  std::vector<double> known_instants();
  std::optional<TimeLine> grid(const TimeItem& item, const std::vector<double>& further);
  std::optional<TimeLine> line_of_stamps(const TimeItem& item, std::vector<double> further);
  bool check_instants();
  void make_unknown(const Symbol& symbol);
  std::optional<Unknowns::Handle> make_element(const Symbol& symbol, const std::string& name,
                                               std::size_t element);
  std::optional<Unknowns::Handle> make_tube(const Symbol& symbol, const std::string& name);
  void state_domain_over_time(const Symbol& symbol, const Expr& domain);
  bool require_time_alone(const Term& term, const Expr& written);
  std::optional<Unknowns::Handle> make_plain(const Symbol& symbol, const std::string& name,
                                             std::size_t element);
  std::optional<Unknowns::Handle> make_parameter(const Symbol& symbol, const std::string& name);
  std::optional<Unknowns::Handle> make_set(const Symbol& symbol, const std::string& name,
                                           const VarItem& item);
  std::optional<double> precision_of(const Expr& expr);
  std::optional<Box> frame_of(const Expr& expr);

  // Time lines with phases (phases.cpp).
  bool make_phases();
  [[nodiscard]] bool is_duration(const Symbol& symbol) const;
  void define_phases();
  void state_over_phases(const Expr& expr, bool wanted);
  std::optional<std::size_t> gate_in(const Expr& expr);
  void report(const PhaseError& error);

  // Constraints (constraints.cpp).
  void compile_constraint(const ConstraintItem& item);
  /// States a relation, or that it does not hold.
  void state(const Expr& expr, bool wanted = true);
  void state_relation(const Expr& expr, bool wanted);
  void state_truth(const Term& relation);
  bool state_equality(const Expr& expr);
  void state_derivative(const Expr& derivative, const Expr& value);
  void state_range(const Expr& range, const Expr& value);
  [[nodiscard]] bool calls(const Expr& expr, BuiltIn function) const;
  std::string next_name();
  std::optional<Term> relation_of(const Expr& expr, bool wanted);

  // Logic (logic.cpp).
  struct Claim {
    const Expr* relation;
    bool wanted;
  };
  /// A relation that is to hold or not, for some values of what a quantifier binds.
  struct Alternative {
    std::vector<Claim> claims;
    std::vector<int> at = {};
  };
  void state_failure_at_instants(const Expr& expr);
  [[nodiscard]] bool chooses_anew(const Expr& expr) const;
  void state_at_each_instant(const Expr& expr, bool wanted);
  void state_call(const Expr& expr, const Symbol& function, bool wanted);
  Value truth_of(const Expr& expr);
  void state_logic(const Expr& expr, bool wanted);
  void state_quantified(const Expr& expr, bool wanted);
  void state_for_each(const Expr& expr, bool wanted);
  void state_at_least(const Expr& expr, int count, std::vector<Alternative> alternatives);
  void state_over_time(const Expr& expr, bool wanted);
  void state_always(const Expr& body, bool wanted);
  void state_sometime(const Expr& body, bool wanted);
  void state_at_an_instant(const Expr& expr, bool wanted);
  std::optional<Window> window_of(const Expr& expr);
  [[nodiscard]] bool connects(const Expr& expr) const;

  // Sets (sets.cpp).
  struct NamedSet {
    const Expr* expr;
    SetVariable set;
  };
  void state_set_relation(const Expr& expr, bool wanted);
  void state_set_equality(const Expr& a, const Expr& b, bool wanted);
  void state_subset(const Expr& a, const Expr& b, bool wanted);
  void state_disjoint(const Expr& a, const Expr& b, bool wanted);
  void state_meets(const Expr& a, const Expr& b, bool wanted);
  void state_point_in_set(const Expr& point, const Expr& set, bool wanted);
  void collect_sets(const Expr& expr, std::vector<NamedSet>& found);
  bool speaks_of_each_instant(const Expr& expr, const Expr& a, const Expr& b, bool wanted) const;
  std::optional<SetVariable> grid_of(const Expr& a, const Expr& b);
  std::optional<SetTerm> set_term(const Expr& expr, SetVariable grid, bool meet_over_time = false);
  std::optional<SetVariable> set_variable(const Expr& expr, SetVariable grid);
  void state_same(SetTerm a, SetTerm b);
  SetVariable set_equal_to(SetTerm term, SetVariable grid);
  bool define_set(SetTerm whole, const Expr& expr, SetVariable grid);
  bool define_by_folding(SetTerm whole, const Expr& expr, SetVariable grid);
  bool is_zone(const Expr& expr) const;
  std::optional<SetBuilder> zone_of(const Expr& expr, bool wanted = true);

  /// Runs an action on the Problem; what it refuses is reported at `range`.
  template <class Action>
  void guarded(const SourceRange& range, Action action) {
    try {
      action();
    } catch (const std::invalid_argument& refused) {
      model_.diagnostics().report(Code::out_of_range, range, refused.what());
    }
  }
  void not_supported(const SourceRange& range, std::string_view what) {
    model_.diagnostics().report(Code::not_supported, range, what);
  }

  Model& model_;
  std::vector<double> further_;
  std::unique_ptr<Problem> problem_;
  Unknowns unknowns_;
  Evaluator evaluator_;
  std::unordered_map<const Symbol*, TubePlan> plans_;
  std::uint32_t alternatives_ = 0;  // how many were stated, each within those around it
  // What is stated of the time at hand: it is one truth, that it holds at every instant; it holds, or does
  // not, at every instant; or at the one instant of at_each_instant().
  enum class OfTime : std::uint8_t { one_truth, every_instant, this_instant };
  OfTime of_time_ = OfTime::one_truth;
  bool in_zone_ = false;  // what is evaluated speaks of the point of a zone
  struct StatedDomain {
    Box box, certain;
  };
  std::optional<StatedDomain> evaluate_domain(const Expr& expr);
  std::unordered_map<const Expr*, std::optional<StatedDomain>> domains_;
  std::string constraint_;  // the name of the constraint at hand
  void (Problem::*state_as_)(std::string, hcsp::Expr) = &Problem::constrain;  // what it is
  SourceRange place_;                                                         // and where it is
  std::unordered_map<std::string, SourceRange> places_;  // of what was stated, by its name
  std::unordered_map<std::string, int> names_;           // of all constraints: how often they were asked for
};

}  // namespace hcsp::lang
