// SPDX-License-Identifier: Apache-2.0
// Running a problem's graph and telling what came of it, as a Result. Internal to the solver.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "solver/problem.h"

namespace hcsp {

/// Which of the library's domains a variable has.
enum class DomainKind : std::uint8_t { real, tube, set, polynomial };

/// A vector unknown: so many real variables, one after another. A contractor of some components is woken by
/// those alone.
struct VectorGroup {
  std::string name;
  std::size_t dim;
};

struct ProblemView {
  const std::string& name;
  const ContractorGraph& graph;
  const std::vector<DomainKind>& kinds;  // by variable
  const std::shared_ptr<const TimeLine>& line;
  const std::map<VariableId, std::vector<Reading>>& readings;
  const std::map<VariableId, Shape>& shapes;
  const std::map<VariableId, VectorGroup>& vectors;  // by their first components
  std::function<Domain(VariableId, const std::function<Interval(VariableId)>&)> polynomials;  // with phases
};

/// The unknowns that are not hidden, in the order of declaration, each with the domain that is given for it;
/// a vector with those of its components.
std::vector<ResultVariable> declared_domains(const ProblemView& problem,
                                             const std::function<Domain(VariableId)>& domain_of);

Result run_problem(const ProblemView& problem, const PropagationOptions& options);

}  // namespace hcsp
