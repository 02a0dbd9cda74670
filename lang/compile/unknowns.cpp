// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lang/compile/compile.h"
#include "lang/compile/compiler.h"
#include "solver/expression/program.h"

namespace hcsp::lang {

namespace {

constexpr double kMostInstants = 1e7;                 // of a time line that a person meant
constexpr std::size_t kMostTubeBounds = 100'000'000;  // of one tube: 1.6 GB

// The values that a model states for an unknown, if any.
const Expr* stated_domain(const Symbol& symbol) {
  if (const auto* given = symbol.as<GivenItem>()) return given->value;
  if (const auto* var = symbol.as<VarItem>()) return var->domain;
  if (const auto* param = symbol.as<ParamItem>()) return param->value;
  return nullptr;
}

}  // namespace

bool is_unknown(const Symbol& symbol) {
  return symbol.unknown || symbol.as<GivenItem>() != nullptr || symbol.as<VarItem>() != nullptr;
}

// Instants that show only when constraints are put together (x(i*dt), i in 1..n) join the time line, and the
// model is compiled once more.
std::unique_ptr<Problem> compile(Model& model) {
  std::vector<double> further;
  while (true) {
    Compiler compiler(model, further);
    std::unique_ptr<Problem> problem = compiler.run();
    const std::vector<double>& missing = compiler.missing_instants();
    if (problem == nullptr || missing.empty()) return problem;
    further.insert(further.end(), missing.begin(), missing.end());
  }
}

std::unique_ptr<Problem> Compiler::run() {
  plan_tubes();
  if (model_.diagnostics().any()) return nullptr;
  for (const Symbol* symbol : model_.definitions) {
    if (symbol->open) make_unknown(*symbol);
  }
  if (model_.has_phases() ? !make_phases() : model_.time != nullptr && !make_time_line()) return nullptr;
  for (const Symbol& symbol : model_.symbols) {
    if (is_unknown(symbol) && !unknowns_.handles.contains(&symbol)) make_unknown(symbol);
  }
  for (const Symbol& symbol : model_.symbols) {
    const Expr* domain = is_unknown(symbol) ? stated_domain(symbol) : nullptr;
    if (domain != nullptr && symbol.type.tube && !is_planned(*domain))
      state_domain_over_time(symbol, *domain);
  }
  if (model_.diagnostics().any()) return nullptr;
  // In the order of definition, so that a long chain of lets is no deep recursion.
  for (const Symbol* symbol : model_.definitions) {
    const auto* let = symbol->as<LetItem>();
    if (!symbol->type.is(Type::Kind::real) || symbol->unknown || symbol->takes_instants) continue;
    evaluator_.define(*symbol, let != nullptr ? *let->value : *symbol->as<ParamItem>()->value);
  }
  for (const Item& item : model_.tree().items) {
    if (const auto* constraint = std::get_if<ConstraintItem>(&item.content)) compile_constraint(*constraint);
  }
  if (!model_.diagnostics().any()) define_phases();
  check_goal();
  if (model_.diagnostics().any()) return nullptr;
  return std::move(problem_);
}

void Compiler::check_goal() {
  const SolveItem::Goal goal = model_.goal->goal;
  if (model_.diagnostics().any() || goal == SolveItem::Goal::propagate) return;
  const bool is_paving = goal == SolveItem::Goal::pave;
  if (model_.goal->precision != nullptr) {
    if (const auto precision = precision_of(*model_.goal->precision)) model_.precision = *precision;
  }
  if (is_paving) find_paved();
  if (is_optimisation(goal)) find_objective();
  if (is_paving ? problem_->is_region() : problem_->is_system()) return;
  const std::string_view named = is_paving                      ? "`solve pave`"
                                 : goal == SolveItem::Goal::all ? "`solve all`"
                                                                : "optimisation";
  const std::string_view of =
      problem_->is_region() ? "with quantifiers over reals" : "of more than relations between numbers";
  for (const Item& item : model_.tree().items) {
    if (std::holds_alternative<SolveItem>(item.content))
      not_supported(item.range, fmt::format("{} {}", named, of));
  }
}

void Compiler::find_objective() {
  const Value objective = evaluator_.value(*model_.goal->arguments.front());
  if (!objective.empty()) model_.objective = expression_of(*problem_, objective.front());
}

// The components of what is paved, in the order of the text.
void Compiler::find_paved() {
  for (const Expr* paved : model_.goal->arguments) {
    for (const Term& term : evaluator_.value(*paved)) {
      const auto& coordinate = std::get<hcsp::Expr>(term);
      const bool is_new =
          std::none_of(model_.paved.begin(), model_.paved.end(),
                       [&](const hcsp::Expr& other) { return other.node() == coordinate.node(); });
      if (!is_new) {
        model_.diagnostics().report(Code::paved_twice, paved->range, paved->range.text().substr(0, 40));
        break;
      }
      model_.paved.push_back(coordinate);
    }
  }
}

// ---- The time line.

// A constant domain is part of the tube; any other, and with phases all, are stated.
bool Compiler::is_planned(const Expr& domain) const {
  return model_.type(domain).known == Known::now && !model_.has_phases();
}

void Compiler::plan_tubes() {
  for (const Symbol& symbol : model_.symbols) {
    const Expr* domain = is_unknown(symbol) ? stated_domain(symbol) : nullptr;
    if (domain == nullptr || !symbol.type.tube || !is_planned(*domain)) continue;
    if (auto plan = plan_tube(model_, evaluator_, *domain)) plans_.emplace(&symbol, std::move(*plan));
  }
}

std::vector<double> Compiler::known_instants() {
  std::vector<double> instants = further_;
  for (const auto& [symbol, plan] : plans_) {
    for (const TubePart& part : plan) instants.insert(instants.end(), part.stamps.begin(), part.stamps.end());
  }
  for (const Expr* instant : model_.instants) {
    if (const auto number = evaluator_.number(*instant)) instants.push_back(number->nearest());
  }
  std::sort(instants.begin(), instants.end());
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  return instants;
}

bool Compiler::make_time_line() {
  const TimeItem& item = *model_.time->as<TimeItem>();
  std::vector<double> further = known_instants();
  const auto line = item.stamps != nullptr ? line_of_stamps(item, std::move(further)) : grid(item, further);
  if (!line) return false;
  problem_->set_time_line(*line);
  return check_instants();
}

std::optional<TimeLine> Compiler::grid(const TimeItem& item, const std::vector<double>& further) {
  const DomainValue span = evaluator_.domain(*item.span);
  const auto step = evaluator_.number(*item.step);
  if (span.empty() || !step) return {};
  const auto end_of = [](const std::optional<Term>& bound) {
    return bound ? std::get<Number>(*bound).nearest() : kInfinity;
  };
  const double start = end_of(span[0].lo);
  const double end = end_of(span[0].hi);
  const double dt = step->nearest();
  if (!std::isfinite(start) || !std::isfinite(end) || start >= end) {
    model_.diagnostics().report(Code::bad_time_span, item.span->range);
    return {};
  }
  if (!(dt > 0) || !std::isfinite(dt)) {
    model_.diagnostics().report(Code::bad_step, item.step->range);
    return {};
  }
  if ((end - start) / dt > kMostInstants) {
    auto& diagnostic = model_.diagnostics().report(Code::too_many_instants, item.step->range, start, end, dt);
    for (const Symbol& symbol : model_.symbols) {
      if (symbol.as<DataItem>() == nullptr) continue;
      diagnostic.note(
          fmt::format("do the stamps of `{0}` have an offset? `[first({0}.t), last({0}.t)]` starts with "
                      "the data, and `time {1} at {0}.t` takes its stamps alone",
                      symbol.name.text, model_.time->name.text));
      break;
    }
    return {};
  }
  std::optional<TimeLine> line;
  guarded(item.span->range, [&] { line = TimeLine::grid(start, end, dt, further); });
  return line;
}

std::optional<TimeLine> Compiler::line_of_stamps(const TimeItem& item, std::vector<double> further) {
  const auto columns = evaluator_.columns(*item.stamps);
  if (!columns) return {};
  auto stamps = instants_of(columns->front(), model_.diagnostics());
  if (!stamps) return {};
  if (stamps->size() < 2) {
    model_.diagnostics().report(Code::bad_time_span, item.stamps->range);
    return {};
  }
  const double start = stamps->front();
  const double end = stamps->back();
  std::erase_if(further, [&](double t) { return t < start || t > end; });
  std::vector<double> all;
  std::set_union(stamps->begin(), stamps->end(), further.begin(), further.end(), std::back_inserter(all));
  std::optional<TimeLine> line;
  guarded(item.stamps->range, [&] { line = TimeLine(std::move(all)); });
  return line;
}

bool Compiler::check_instants() {
  const TimeLine& line = *problem_->time_line();
  bool good = true;
  for (const Expr* instant : model_.instants) {
    const auto number = evaluator_.number(*instant);
    if (!number) {
      good = false;
    } else if (!line.gate_at(number->nearest())) {
      model_.diagnostics().report(Code::off_the_time_line, instant->range, number->nearest(), line.start(),
                                  line.end());
      good = false;
    }
  }
  return good;
}

// ---- Unknowns.

// Of an array one unknown an element, called x[1, 2], the last index fastest.
void Compiler::make_unknown(const Symbol& symbol) {
  std::vector<int> indices;
  for (const Extent& extent : symbol.type.arrays) indices.push_back(extent.first);
  const std::string name(symbol.name.text);
  const std::size_t elements = symbol.type.terms() / symbol.type.components();
  for (std::size_t element = 0; element < elements; ++element) {
    const std::string own = indices.empty() ? name : fmt::format("{}[{}]", name, fmt::join(indices, ", "));
    guarded(symbol.name.range, [&] {
      const auto handle = make_element(symbol, own, element);
      if (!handle) return;
      unknowns_.handles[&symbol].push_back(*handle);
      if (indices.empty()) return;
      const VariableId id = std::visit([](const auto& variable) { return variable.id; }, *handle);
      problem_->place_in_array(id, name, indices);
    });
    if (model_.diagnostics().any()) return;
    for (std::size_t k = indices.size(); k-- > 0;) {
      if (++indices[k] <= symbol.type.arrays[k].last) break;
      indices[k] = symbol.type.arrays[k].first;
    }
  }
}

std::optional<Unknowns::Handle> Compiler::make_element(const Symbol& symbol, const std::string& name,
                                                       std::size_t element) {
  if (symbol.type.is(Type::Kind::set)) return make_set(symbol, name, *symbol.as<VarItem>());
  if (symbol.type.tube) return make_tube(symbol, name);
  return make_plain(symbol, name, element);
}

std::optional<Unknowns::Handle> Compiler::make_tube(const Symbol& symbol, const std::string& name) {
  if (model_.has_phases()) return problem_->tube(name, symbol.type.components());
  const std::size_t bounds = problem_->time_line()->items() * symbol.type.components();
  if (bounds > kMostTubeBounds) {
    model_.diagnostics().report(
        Code::out_of_range, symbol.name.range,
        fmt::format("a tube of {} components and {} instants", symbol.type.components(),
                    problem_->time_line()->instants().size()));
    return {};
  }
  const auto plan = plans_.find(&symbol);
  if (plan == plans_.end()) return problem_->tube(name, symbol.type.components());
  auto given = build_tube(model_, plan->second, problem_->time_line());
  if (!given) return {};
  const TubeVariable tube = problem_->tube(name, given->domain);
  // Also when every reading is blank: the tube is then known nowhere, but it is known at its samples only.
  const bool is_sampled = std::any_of(plan->second.begin(), plan->second.end(), [](const TubePart& part) {
    return part.kind == TubePart::Kind::sampled;
  });
  if (is_sampled) problem_->set_readings(tube, std::move(given->readings));
  return tube;
}

// A domain that is computed from the time holds at every instant.
void Compiler::state_domain_over_time(const Symbol& symbol, const Expr& domain) {
  DomainValue bounds;
  if (model_.type(domain).is(Type::Kind::real)) {
    for (const Term& term : evaluator_.value(domain)) bounds.push_back({term, term});
  } else {
    bounds = evaluator_.domain(domain);
  }
  constraint_ = fmt::format("domain of {}", symbol.name.text);
  place_ = domain.range;
  std::size_t component = 0;
  for (const Unknowns::Handle& handle : unknowns_.handles.at(&symbol)) {
    // A domain of one element serves all of an array.
    if (component == bounds.size()) component = 0;
    for (const hcsp::Expr& x : (*problem_)(std::get<TubeVariable>(handle))) {
      if (component == bounds.size()) return;  // after a report
      const Bounds& bound = bounds[component++];
      for (const auto& [end, is_lower] : {std::pair(bound.lo, true), std::pair(bound.hi, false)}) {
        if (!end) continue;
        if (!require_time_alone(*end, domain)) return;
        const hcsp::Expr value = expression_of(*problem_, *end);
        problem_->constrain(next_name(), is_lower ? value <= x : x <= value);
      }
    }
  }
}

bool Compiler::require_time_alone(const Term& term, const Expr& written) {
  const auto* expr = std::get_if<hcsp::Expr>(&term);
  if (expr == nullptr) return true;
  const Program program(expr->dag(), {expr->node()});
  const bool alone = std::all_of(program.inputs().begin(), program.inputs().end(),
                                 [](const Input& input) { return input.kind == Input::Kind::time; });
  if (!alone) model_.diagnostics().report(Code::not_constant, written.range);
  return alone;
}

std::optional<Unknowns::Handle> Compiler::make_plain(const Symbol& symbol, const std::string& name,
                                                     std::size_t element) {
  const Type& type = symbol.type;
  if (type.is(Type::Kind::boolean)) return problem_->boolean(name);
  if (symbol.open) return make_parameter(symbol, name);
  Box box(static_cast<Eigen::Index>(type.components())), certain = box;
  if (const Expr* domain = stated_domain(symbol)) {
    // A domain of one element serves them all.
    auto& stated = domains_[domain];
    if (!stated) stated = evaluate_domain(*domain);
    if (!stated) return {};
    const bool is_of_all = static_cast<std::size_t>(stated->box.dim()) == type.terms();
    const auto first = static_cast<Eigen::Index>(is_of_all ? element * type.components() : 0);
    for (Eigen::Index i = 0; i < box.dim(); ++i) {
      box[i] = stated->box[first + i];
      certain[i] = stated->certain[first + i];
    }
  }
  if (is_duration(symbol)) {
    for (Eigen::Index i = 0; i < box.dim(); ++i) {
      box[i] = meet(box[i], Interval(0.0, kInfinity));
      certain[i] = meet(certain[i], box[i]);
    }
  }
  const auto made = [&](auto unknown) -> Unknowns::Handle {
    for (Eigen::Index i = 0; i < box.dim(); ++i) {
      if (!(certain[i] == box[i]))
        problem_->set_certain_domain(unknown.id + static_cast<VariableId>(i), certain[i]);
    }
    return unknown;
  };
  if (type.is_matrix()) return made(problem_->matrix(name, type.dim, box));
  if (type.dim != 0) return made(problem_->vector(name, box));
  if (type.whole) return made(problem_->integer(name, box[0]));
  return made(problem_->real(name, box[0]));
}

// Its value may be an expression of other parameters.
std::optional<Unknowns::Handle> Compiler::make_parameter(const Symbol& symbol, const std::string& name) {
  const Value value = evaluator_.value(*symbol.as<ParamItem>()->value);
  if (value.empty()) return {};
  VectorExpr follows;
  Box box(static_cast<Eigen::Index>(value.size()));
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto* number = std::get_if<Number>(&value[i]);
    if (number != nullptr) box[static_cast<Eigen::Index>(i)] = number->enclosure;
    follows.push_back(expression_of(*problem_, value[i]));
  }
  const bool is_known = std::all_of(value.begin(), value.end(),
                                    [](const Term& term) { return std::holds_alternative<Number>(term); });
  if (symbol.type.is_scalar())
    return is_known ? problem_->parameter(name, box[0]) : problem_->parameter(name, follows.front());
  return is_known ? problem_->parameter_vector(name, box) : problem_->parameter_vector(name, follows);
}

std::optional<Compiler::StatedDomain> Compiler::evaluate_domain(const Expr& expr) {
  auto box = evaluator_.box(expr);
  auto certain = box ? evaluator_.certain_box(expr) : std::nullopt;
  if (!certain) return {};
  return StatedDomain{std::move(*box), std::move(*certain)};
}

std::optional<double> Compiler::precision_of(const Expr& expr) {
  const auto number = evaluator_.number(expr);
  if (!number) return {};
  const double precision = number->nearest();
  if (precision > 0 && std::isfinite(precision)) return precision;
  model_.diagnostics().report(Code::bad_precision, expr.range, precision);
  return {};
}

std::optional<Box> Compiler::frame_of(const Expr& expr) {
  auto box = evaluator_.box(expr);
  if (!box) return {};
  for (Eigen::Index i = 0; i < box->dim(); ++i) {
    if (!(*box)[i].is_bounded()) {
      model_.diagnostics().report(Code::unbounded_frame, expr.range);
      return {};
    }
    if ((*box)[i].lo() >= (*box)[i].hi()) {
      model_.diagnostics().report(Code::flat_frame, expr.range, i + 1);
      return {};
    }
  }
  return box;
}

std::optional<Unknowns::Handle> Compiler::make_set(const Symbol& symbol, const std::string& name,
                                                   const VarItem& item) {
  const auto precision = precision_of(*item.precision);
  std::optional<Box> frame;
  if (item.domain != nullptr) frame = frame_of(*item.domain);
  if (!precision || (item.domain != nullptr && !frame)) return {};
  return problem_->set(name, symbol.type.dim, *precision, frame);
}

}  // namespace hcsp::lang
