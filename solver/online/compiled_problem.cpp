// SPDX-License-Identifier: Apache-2.0
#include "solver/online/compiled_problem.h"

#include <algorithm>
#include <cmath>

#include "domains/rounding.h"
#include "solver/online/compiler.h"
#include "solver/online/search.h"

namespace hcsp {

std::string_view to_string(OnlineStatus status) {
  switch (status) {
    case OnlineStatus::solved:
      return "solved";
    case OnlineStatus::infeasible:
      return "infeasible";
    case OnlineStatus::undecided:
      return "undecided";
    default:
      return "invalid";
  }
}

struct CompiledProblem::Impl {
  online::Compiled compiled;
  online::Machine machine;
  online::Search search;
  std::vector<Interval> parameters;
  std::vector<std::uint8_t> is_invalid;   // by parameter
  std::vector<std::uint8_t> is_set;       // by parameter
  std::vector<std::uint8_t> has_changed;  // by parameter: since the last solve
  std::vector<Interval> values;           // by variable of the problem
  std::vector<Interval> outputs;          // of the options
  OnlineStatus status = OnlineStatus::undecided;
  Interval objective = Interval::empty();
  std::string_view reason;
  bool is_found = false;

  Impl(online::Compiled all, const OnlineOptions& options)
      : compiled(std::move(all)),
        machine(compiled.prefix, compiled.most_registers(), compiled.most_core(), compiled.most_surfaces()),
        search(machine, compiled.cases, compiled.givens, compiled.is_decisive, compiled.has_objective,
               {options.most_boxes, options.precision}),
        parameters(compiled.parameter_values),
        is_invalid(parameters.size()),
        is_set(parameters.size()),
        has_changed(parameters.size(), 1),
        values(compiled.variables),
        outputs(options.outputs.size()) {}

  template <class Number>
  bool set(Parameter parameter, std::span<const Number> given);
  void solve();
  void read_solution();
  void read_tube(online::WantedTube& own);
  [[nodiscard]] const online::CompiledCase& case_of_solution() const {
    return compiled.cases[search.finding().best_case];
  }
};

namespace {

bool is_valid(double x) { return std::isfinite(x); }
bool is_valid(const Interval& x) { return !x.is_empty() && x.is_bounded(); }
Interval as_interval(double x) { return Interval::raw(x, x); }
Interval as_interval(const Interval& x) { return x; }

}  // namespace

template <class Number>
bool CompiledProblem::Impl::set(Parameter parameter, std::span<const Number> given) {
  if (parameter.size == 0 || parameter.first + parameter.size > parameters.size()) return false;
  const bool is_good = given.size() == parameter.size &&
                       std::all_of(given.begin(), given.end(), [](const Number& x) { return is_valid(x); });
  std::fill_n(&is_invalid[parameter.first], parameter.size, static_cast<std::uint8_t>(is_good ? 0 : 1));
  if (!is_good) return false;
  for (std::size_t i = 0; i < given.size(); ++i) {
    parameters[parameter.first + i] = as_interval(given[i]);
    is_set[parameter.first + i] = has_changed[parameter.first + i] = 1;
  }
  return true;
}

void CompiledProblem::Impl::solve() {
  is_found = false;
  objective = Interval::empty();
  reason = {};
  const auto bad = std::find(is_invalid.begin(), is_invalid.end(), std::uint8_t{1});
  if (bad != is_invalid.end()) {
    status = OnlineStatus::invalid;
    reason = compiled.parameter_names[static_cast<std::size_t>(bad - is_invalid.begin())];
    return;
  }
  const RoundUpward guard;
  compiled.followers.update(parameters, is_set, has_changed);
  machine.load(parameters);
  const online::Finding& finding = search.run();
  is_found = finding.is_found;
  if (is_found) {
    objective = Interval::raw(finding.lower, finding.best.hi());
    read_solution();
  }
  const bool is_refuted = !is_found && !finding.is_exhausted && finding.lower == kInfinity;
  const bool is_bracketed = !compiled.has_objective || search.limits().is_known_well(objective);
  const bool is_of_all = finding.is_decided || !compiled.has_family;
  status = is_refuted && is_of_all    ? OnlineStatus::infeasible
           : is_found && is_bracketed ? OnlineStatus::solved
                                      : OnlineStatus::undecided;
  if (is_refuted && !compiled.names.empty()) reason = compiled.names[finding.refuted_by];
}

void CompiledProblem::Impl::read_solution() {
  const online::Code& proof = case_of_solution().proof;
  machine.recall(proof);
  machine.evaluate_further(proof);
  const std::vector<online::Source>& sources = compiled.sources[search.finding().best_case];
  for (std::size_t v = 0; v < values.size(); ++v) {
    const online::Source& source = sources[v];
    values[v] = source.is_register ? machine.value(source.reg) : source.value;
  }
  const std::size_t first = compiled.has_objective ? 1 : 0;
  for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i] = machine.value(proof.wanted[first + i]);
  for (online::WantedTube& own : compiled.tubes) {
    if (own.is_asked_for) read_tube(own);
  }
}

// At the solution that the machine is evaluated at.
void CompiledProblem::Impl::read_tube(online::WantedTube& own) {
  const auto from = std::span(case_of_solution().proof.wanted).subspan(own.first);
  own.tube.assign([&](std::size_t i) { return machine.value(from[i]); });
}

CompiledProblem::CompiledProblem(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CompiledProblem::CompiledProblem(CompiledProblem&&) noexcept = default;
CompiledProblem& CompiledProblem::operator=(CompiledProblem&&) noexcept = default;
CompiledProblem::~CompiledProblem() = default;

namespace {

const online::Named& named(const std::map<std::string, online::Named>& places, std::string_view name,
                           std::string_view kind) {
  const auto found = places.find(std::string(name));
  if (found == places.end())
    throw std::out_of_range(fmt::format("compile: `{}` is no {} of the compiled problem", name, kind));
  return found->second;
}

}  // namespace

CompiledProblem::Parameter CompiledProblem::parameter(std::string_view name) const {
  const online::Named& found = named(impl_->compiled.parameter_places, name, "parameter");
  return {found.first, found.size};
}

CompiledProblem::Variable CompiledProblem::variable(std::string_view name) const {
  const online::Named& found = named(impl_->compiled.variable_places, name, "unknown");
  return {found.first, found.size};
}

CompiledProblem::Tube CompiledProblem::tube(std::string_view name) const {
  std::vector<online::WantedTube>& all = impl_->compiled.tubes;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  if (found == all.end())
    throw std::out_of_range(fmt::format("compile: `{}` is no tube of the compiled problem", name));
  // A motion of many joints has thousands of coefficients: they are read of the tubes that are asked for.
  if (!found->is_asked_for && impl_->is_found) impl_->read_tube(*found);
  found->is_asked_for = true;
  return {static_cast<std::size_t>(found - all.begin())};
}

bool CompiledProblem::set(Parameter parameter, std::span<const double> values) noexcept {
  return impl_->set(parameter, values);
}
bool CompiledProblem::set(Parameter parameter, std::span<const Interval> values) noexcept {
  return impl_->set(parameter, values);
}
OnlineStatus CompiledProblem::solve() noexcept {
  impl_->solve();
  return impl_->status;
}
void CompiledProblem::forget() noexcept { impl_->search.forget(); }

OnlineStatus CompiledProblem::status() const noexcept { return impl_->status; }
Interval CompiledProblem::objective() const noexcept { return impl_->objective; }
bool CompiledProblem::has_solution() const noexcept { return impl_->is_found; }
std::span<const Interval> CompiledProblem::value(Variable variable) const noexcept {
  const std::span<const Interval> all = impl_->values;
  if (!impl_->is_found || variable.first + variable.size > all.size()) return {};
  return all.subspan(variable.first, variable.size);
}
Interval CompiledProblem::value(RealVariable variable) const noexcept {
  const std::span<const Interval> one = value(Variable{variable.id, 1});
  return one.empty() ? Interval::empty() : one[0];
}
const PolynomialTube& CompiledProblem::value(Tube tube) const noexcept {
  return impl_->compiled.tubes[tube.index].tube;
}
std::span<const Interval> CompiledProblem::outputs() const noexcept {
  if (!impl_->is_found) return {};
  return impl_->outputs;
}
std::string_view CompiledProblem::reason() const noexcept { return impl_->reason; }
std::size_t CompiledProblem::boxes() const noexcept { return impl_->search.boxes(); }
std::size_t CompiledProblem::cases() const noexcept { return impl_->compiled.cases.size(); }

CompiledProblem compile(Problem& problem, const std::optional<Expr>& objective,
                        const OnlineOptions& options) {
  require(options.precision > 0, "compile: a precision of {}", options.precision);
  online::Compiled compiled =
      online::compile_cases(online::question_of(problem, objective, options.outputs), options.most_cases);
  return CompiledProblem(std::make_unique<CompiledProblem::Impl>(std::move(compiled), options));
}

}  // namespace hcsp
