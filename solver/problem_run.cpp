// SPDX-License-Identifier: Apache-2.0
#include "solver/problem_run.h"

#include <algorithm>
#include <cmath>

#include "solver/support.h"

namespace hcsp {

namespace {

Domain domain_of(const ProblemView& problem, const Propagation& run, VariableId id) {
  switch (problem.kinds[id]) {
    case DomainKind::real:
      return run.domain<Interval>(id);
    case DomainKind::tube:
      return run.domain<Tube>(id);
    case DomainKind::set:
      return run.domain<SetInterval>(id);
    case DomainKind::polynomial:
      return problem.polynomials(id, [&](VariableId real) { return run.domain<Interval>(real); });
  }
  return Interval::empty();
}

std::vector<ResultVariable> declared_domains(const ProblemView& problem, const Propagation& run) {
  return declared_domains(problem, [&](VariableId id) { return domain_of(problem, run, id); });
}

// What people call a variable: a component by its vector's name.
const std::string& name_of(const ProblemView& problem, VariableId id) {
  auto after = problem.vectors.upper_bound(id);
  if (after != problem.vectors.begin()) {
    const auto& [first, vector] = *--after;
    if (id < first + vector.dim) return vector.name;
  }
  return problem.graph.variable(id).name();
}

std::vector<Interval> components_at(const Tube& tube, std::size_t item) {
  std::vector<Interval> components;
  for (std::size_t c = 0; c < tube.dim(); ++c) components.push_back(tube.at(c, item));
  return components;
}

// Records snapshots and traces as a run goes.
class Recorder final : public Propagation::Observer {
 public:
  Recorder(const ProblemView& problem, const PropagationOptions& options, Result& result)
      : problem_(problem), options_(options), result_(result) {}

  void before_contractor(const Propagation& run, ContractorId id) override {
    if (!options_.keep_trace) return;
    before_.clear();
    for (const VariableId v : problem_.graph.contractors()[id]->writes())
      before_.push_back(domain_of(problem_, run, v));
  }

  void after_contractor(const Propagation& run, ContractorId id) override {
    if (!options_.keep_trace) return;
    const Contractor& contractor = *problem_.graph.contractors()[id];
    for (std::size_t k = 0; k < contractor.writes().size(); ++k) {
      const VariableId v = contractor.writes()[k];
      TraceEntry entry{run.passes(), contractor.name(), problem_.graph.variable(v).name(), 0.0, 0.0, {}};
      entry.measure_before = std::visit([](const auto& d) { return measure(d); }, before_[k]);
      entry.measure_after = run.slot(v).open();
      if (problem_.kinds[v] == DomainKind::tube)
        add_changes(entry, std::get<Tube>(before_[k]), run.domain<Tube>(v));
      result_.trace.push_back(std::move(entry));
    }
  }

  void after_pass(const Propagation& run) override {
    if (options_.keep_snapshots) result_.snapshots.push_back({run.passes(), declared_domains(problem_, run)});
  }

 private:
  static void add_changes(TraceEntry& entry, const Tube& before, const Tube& after) {
    for (std::size_t item = 0; item < before.items(); ++item) {
      std::vector<Interval> was = components_at(before, item), is = components_at(after, item);
      if (was == is) continue;
      const Interval span = before.line().span(item);
      entry.changes.push_back({{span.lo(), span.hi()}, std::move(was), std::move(is)});
    }
  }

  const ProblemView& problem_;
  const PropagationOptions& options_;
  Result& result_;
  std::vector<Domain> before_;  // of the variables that the running contractor writes
};

// All readings of a problem, numbered through.
struct NumberedReading {
  VariableId variable;
  const Reading* reading;
};

std::vector<NumberedReading> readings_of(const ProblemView& problem) {
  std::vector<NumberedReading> readings;
  for (const auto& [variable, list] : problem.readings) {
    for (const Reading& reading : list) readings.push_back({variable, &reading});
  }
  return readings;
}

// How the problem fails with only some of its readings, if it does: the others are unknown at their instants.
std::optional<Failure> failure_with(const ProblemView& problem, const PropagationOptions& options,
                                    const std::vector<NumberedReading>& readings,
                                    const std::vector<std::size_t>& kept) {
  std::vector<bool> keep(readings.size(), false);
  for (const std::size_t i : kept) keep[i] = true;
  Propagation run(problem.graph, options);
  for (const auto& [variable, list] : problem.readings) {
    Tube tube = run.domain<Tube>(variable);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (readings[i].variable != variable || keep[i]) continue;
      for (std::size_t c = 0; c < tube.dim(); ++c)
        tube.set(c, 2 * readings[i].reading->gate, Interval::entire());
    }
    run.set_domain(variable, std::move(tube));
  }
  run.run();
  return run.failure();
}

void tell_failure(const ProblemView& problem, const Failure& failure, Explanation& explanation) {
  explanation.variable = name_of(problem, failure.variable);
  explanation.constraint = failure.contractor ? problem.graph.contractors()[*failure.contractor]->constraint()
                                              : fmt::format("domain of {}", explanation.variable);
  explanation.time = failure.time;
}

// A minimal conflict among the readings, those next to where the failure showed first; and how the problem
// fails with that conflict alone, which is nearer to the cause than where a run with all readings happened to
// notice.
void find_support(const ProblemView& problem, const PropagationOptions& options, double started,
                  const std::vector<NumberedReading>& readings, Explanation& explanation) {
  const auto time_of = [&](std::size_t i) { return problem.line->instants()[readings[i].reading->gate]; };
  std::vector<std::size_t> preferred(readings.size());
  for (std::size_t i = 0; i < preferred.size(); ++i) preferred[i] = i;
  if (explanation.time) {
    const double when = (*explanation.time)[0];
    std::stable_sort(preferred.begin(), preferred.end(), [&](std::size_t i, std::size_t j) {
      return std::abs(time_of(i) - when) < std::abs(time_of(j) - when);
    });
  }
  const auto stop = [&] {
    const bool cancelled = options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed);
    const bool late = options.time_limit > 0 && options.clock() - started >= options.time_limit;
    if (cancelled || late) explanation.support_is_complete = false;
    return cancelled || late;
  };
  PropagationOptions probe = options;
  probe.keep_snapshots = probe.keep_trace = false;
  probe.progress = {};
  const auto infeasible = [&](const std::vector<std::size_t>& kept) {
    return failure_with(problem, probe, readings, kept).has_value();
  };
  const std::vector<std::size_t> support = minimal_conflict(preferred, infeasible, stop);
  for (const std::size_t i : support) {
    explanation.support.push_back(
        {problem.graph.variable(readings[i].variable).name(), time_of(i), readings[i].reading->source});
  }
  if (const auto failure = failure_with(problem, probe, readings, support))
    tell_failure(problem, *failure, explanation);
}

}  // namespace

std::vector<ResultVariable> declared_domains(const ProblemView& problem,
                                             const std::function<Domain(VariableId)>& domain_of) {
  const auto box_of = [&](VariableId first, std::size_t dim) {
    Box box(static_cast<Eigen::Index>(dim));
    for (Eigen::Index i = 0; i < box.dim(); ++i)
      box[i] = std::get<Interval>(domain_of(first + static_cast<VariableId>(i)));
    return box;
  };
  std::vector<ResultVariable> variables;
  for (VariableId id = 0; id < problem.kinds.size();) {
    const auto& variable = problem.graph.variable(id);
    const auto vector = problem.vectors.find(id);
    const bool is_vector = vector != problem.vectors.end();
    if (!variable.hidden()) {
      const auto shape = problem.shapes.find(id);
      variables.push_back({is_vector ? vector->second.name : variable.name(),
                           is_vector ? Domain(box_of(id, vector->second.dim)) : domain_of(id),
                           shape == problem.shapes.end() ? Shape{} : shape->second});
    }
    id += static_cast<VariableId>(is_vector ? vector->second.dim : 1);
  }
  return variables;
}

Result run_problem(const ProblemView& problem, const PropagationOptions& options) {
  Result result;
  result.model = problem.name;
  const double started = options.clock();
  Propagation run(problem.graph, options);
  Recorder recorder(problem, options, result);
  const Ending ending = run.run(&recorder);
  result.statistics.seconds = options.spent_before + options.clock() - started;
  result.statistics.passes = run.passes();
  result.statistics.threads = 1;  // propagation runs on the calling thread
  for (ContractorId id = 0; id < problem.graph.contractors().size(); ++id) {
    const auto& count = run.counts()[id];
    result.statistics.contractors.push_back(
        {problem.graph.contractors()[id]->name(), count.calls, count.seconds});
  }
  result.status = ending == Ending::empty ? Status::infeasible
                                          : (ending == Ending::limit ? Status::limit : Status::contracted);
  result.variables = declared_domains(problem, run);
  if (run.failure()) {
    Explanation explanation;
    tell_failure(problem, *run.failure(), explanation);
    const std::vector<NumberedReading> readings = readings_of(problem);
    if (options.explain && !readings.empty()) find_support(problem, options, started, readings, explanation);
    result.explanation = std::move(explanation);
  }
  return result;
}

}  // namespace hcsp
