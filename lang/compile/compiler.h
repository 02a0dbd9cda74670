// SPDX-License-Identifier: Apache-2.0
// The compiler's state. Its functions are spread over unknowns.cpp (the time line and the unknowns) and
// constraints.cpp.
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

class Compiler {
 public:
  explicit Compiler(Model& model)
      : model_(model),
        problem_(std::make_unique<Problem>(model.name)),
        unknowns_{*problem_, {}},
        evaluator_(model, unknowns_) {}

  std::unique_ptr<Problem> run();

 private:
  // The time line and the unknowns.
  void plan_tubes();
  bool make_time_line();
  std::vector<double> known_instants();
  std::optional<TimeLine> grid(const TimeItem& item, const std::vector<double>& further);
  std::optional<TimeLine> line_of_stamps(const TimeItem& item, std::vector<double> further);
  bool check_instants();
  void make_unknown(const Symbol& symbol);
  std::optional<Unknowns::Handle> make_element(const Symbol& symbol, const std::string& name,
                                               std::size_t element);
  std::optional<Unknowns::Handle> make_tube(const Symbol& symbol, const std::string& name);
  std::optional<Unknowns::Handle> make_plain(const Symbol& symbol, const std::string& name,
                                             std::size_t element);
  std::optional<Unknowns::Handle> make_set(const Symbol& symbol, const std::string& name,
                                           const VarItem& item);
  std::optional<double> precision_of(const Expr& expr);
  std::optional<Box> frame_of(const Expr& expr);

  // Constraints.
  void compile_constraint(const ConstraintItem& item);
  void state(const Expr& expr);
  void state_relation(const Expr& expr);
  bool state_equality(const Expr& expr);
  void state_derivative(const Expr& derivative, const Expr& value);
  void state_union(const Expr& set, const Expr& zone);
  void state_disjoint(const Expr& expr);
  void state_meets(const Expr& expr);
  void state_range(const Expr& range, const Expr& value);
  [[nodiscard]] bool is_plain(const Expr& expr) const;
  [[nodiscard]] bool calls(const Expr& expr, BuiltIn function) const;
  /// The symbol of a set unknown that the expression names; reports otherwise.
  const Symbol* set_symbol(const Expr& expr);
  std::optional<SetBuilder> zone_of(const Expr& expr);
  std::string next_name();
  void state_for_each(const Expr& expr);
  hcsp::Expr relation_of(const Term& term);

  /// Runs an action on the Problem; what it refuses is reported at `range`.
  template <class Action>
  void guarded(const SourceRange& range, Action action) {
    try {
      action();
    } catch (const std::invalid_argument& refused) {
      model_.diagnostics().report(Code::out_of_range, range, refused.what());
    }
  }
  [[nodiscard]] const SetVariable& set_of(const Symbol& symbol) const {
    return std::get<SetVariable>(unknowns_.handles.at(&symbol).front());
  }

  Model& model_;
  std::unique_ptr<Problem> problem_;
  Unknowns unknowns_;
  Evaluator evaluator_;
  std::unordered_map<const Symbol*, TubePlan> plans_;
  std::unordered_map<const Symbol*, double> precisions_;
  std::unordered_map<const Expr*, std::optional<Box>> domains_;  // as they were stated
  std::string constraint_;                                       // the name of the constraint at hand
  std::unordered_map<std::string, int> names_;  // of all constraints: how often they were asked for
};

}  // namespace hcsp::lang
